#include "fmi/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

SharedLibrary::SharedLibrary(const std::string& path)
    : path_(path), handle_(::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw InputError(fmt::format("cannot be loaded: {}", ::dlerror()));
}

void* SharedLibrary::symbol(const char* name) const {
  void* found = ::dlsym(handle_, name);
  if (!found) throw InputError(fmt::format("{}: has no function {}", path_, name));
  return found;
}

}  // namespace ballbot
