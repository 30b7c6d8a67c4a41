// The library that importers load. It holds nothing but the functions of the standard, each a jump
// into the core beside it, which is loaded so that it and its libraries look for symbols among
// themselves first. A host that has Simbody or a LAPACK of its own loaded would lend us those
// otherwise, and the results would depend on who imports the FMU.
#include <cstdio>
#include <cstring>

#include <dlfcn.h>

#if BALLBOT_FMI_VERSION == 2
#include "fmi/fmi2_library.hpp"
#define BALLBOT_FUNCTIONS BALLBOT_FMI2_FUNCTIONS
#else
#include "fmi/fmi3_library.hpp"
#define BALLBOT_FUNCTIONS BALLBOT_FMI3_FUNCTIONS
#endif

// x86-64 only, like the shared objects of the FMU as a whole.
#define BALLBOT_JUMP(name)                                                      \
  extern "C" {                                                                  \
  __attribute__((visibility("hidden"))) void* ballbot_to_##name;                \
  }                                                                             \
  asm(".pushsection .text\n.globl " #name "\n.type " #name ",@function\n" #name \
      ":\n\tjmp *ballbot_to_" #name "(%rip)\n.size " #name ",.-" #name "\n.popsection\n");
BALLBOT_FUNCTIONS(BALLBOT_JUMP)

namespace {

// What calls get if the core cannot be loaded: no instance, no version, an error.
void* nothing() { return nullptr; }
int error() { return 3; }

void* stand_in(const char* name) {
  const bool pointer = std::strstr(name, "Instantiate") || std::strstr(name, "GetVersion") ||
                       std::strstr(name, "GetTypesPlatform");
  return pointer ? reinterpret_cast<void*>(nothing) : reinterpret_cast<void*>(error);
}

void* loadCore() {
  Dl_info self{};
  if (::dladdr(reinterpret_cast<void*>(loadCore), &self) == 0) return nullptr;
  const char* slash = std::strrchr(self.dli_fname, '/');
  const int folder = slash ? static_cast<int>(slash - self.dli_fname) + 1 : 0;
  char path[4096];
  const int size =
      std::snprintf(path, sizeof path, "%.*s%s", folder, self.dli_fname, BALLBOT_FMU_CORE);
  if (size < 0 || size >= static_cast<int>(sizeof path)) return nullptr;
  void* core = ::dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (!core) std::fprintf(stderr, "ballbot FMU: %s\n", ::dlerror());
  return core;
}

__attribute__((constructor)) void connect() {
  void* core = loadCore();
  const auto find = [core](const char* name) {
    void* found = core ? ::dlsym(core, name) : nullptr;
    return found ? found : stand_in(name);
  };
#define BALLBOT_FIND(name) ballbot_to_##name = find(#name);
  BALLBOT_FUNCTIONS(BALLBOT_FIND)
#undef BALLBOT_FIND
}

}  // namespace
