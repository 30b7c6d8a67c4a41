#pragma once

#include <string>

namespace ballbot {

/// That this process, and no other, serves a link: a lock on the file LINK.lock, in which its
/// number stands. The lock ends with the process, however it ends.
class LinkClaim {
 public:
  /// @throw InputError naming the process that serves the link; OutputError if the lock's file
  /// cannot
  ///        be made.
  explicit LinkClaim(const std::string& link);
  ~LinkClaim();
  LinkClaim(const LinkClaim&) = delete;
  LinkClaim& operator=(const LinkClaim&) = delete;

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace ballbot
