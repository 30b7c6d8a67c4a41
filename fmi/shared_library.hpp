#pragma once

#include <initializer_list>
#include <set>
#include <string>

namespace ballbot {

/// A shared object, loaded at run time with its symbols kept to itself. It stays loaded for the
/// life of the process: FMUs may have threads or exit handlers that an unloading would pull the
/// ground from under.
class SharedLibrary {
 public:
  /// @throw InputError with the loader's own words.
  explicit SharedLibrary(const std::string& path);

  /// The function of that name. In place of one that is missing comes one that returns 3, which is
  /// an error in both versions of FMI: many FMUs lack what a use of them does not need.
  template <typename Function>
  Function find(const char* name) {
    return reinterpret_cast<Function>(symbol(name));
  }
  /// @throw InputError if one of these was looked for and is missing; names it.
  void require(std::initializer_list<const char*> names) const;

 private:
  void* symbol(const char* name);

  std::string path_;
  void* handle_;
  std::set<std::string> missing_;
};

}  // namespace ballbot
