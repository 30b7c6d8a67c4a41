#include "fmi/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

int standIn() { return 3; }

}  // namespace

SharedLibrary::SharedLibrary(const std::string& path)
    : path_(path), handle_(::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw InputError(fmt::format("cannot be loaded: {}", ::dlerror()));
}

void* SharedLibrary::symbol(const char* name) {
  if (void* found = ::dlsym(handle_, name)) return found;
  missing_.insert(name);
  return reinterpret_cast<void*>(standIn);
}

void SharedLibrary::require(std::initializer_list<const char*> names) const {
  for (const char* name : names) {
    if (missing_.count(name) != 0) {
      throw InputError(fmt::format("{}: has no function {}", path_, name));
    }
  }
}

}  // namespace ballbot
