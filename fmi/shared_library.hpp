#pragma once

#include <string>

namespace ballbot {

/// A shared object, loaded at run time with its symbols kept to itself. It stays loaded for the
/// life of the process: FMUs may have threads or exit handlers that an unloading would pull the
/// ground from under.
class SharedLibrary {
 public:
  /// @throw InputError with the loader's own words.
  explicit SharedLibrary(const std::string& path);

  /// @throw InputError if there is no such function.
  template <typename Function>
  Function find(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;

  std::string path_;
  void* handle_;
};

}  // namespace ballbot
