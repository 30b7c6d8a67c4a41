#pragma once

#include <string>

#include <sys/types.h>

namespace ballbot {

/// A folder below the temporary one that goes when this process ends, however it ends: a second,
/// small process waits for that and removes it. For a process that foreign code may crash, hang or
/// kill. To be made before there are threads.
class ScratchFolder {
 public:
  /// @param kept_open a file descriptor that the second process holds until the folder is gone, so
  ///        that whoever waits for the end of that file knows it is; -1 for none
  /// @throw OutputError if it cannot be created.
  explicit ScratchFolder(int kept_open = -1);
  /// Returns when the folder is gone.
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int life_ = -1;  ///< closed by the kernel at the latest
  pid_t remover_ = -1;
};

}  // namespace ballbot
