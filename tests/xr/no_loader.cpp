// A machine without OpenXR's loader: put before a program by LD_PRELOAD.
#include <dlfcn.h>

#include <cstring>

extern "C" __attribute__((visibility("default"))) void* dlopen(const char* name, int flags) {
  using Open = void* (*)(const char*, int);
  static const auto open = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "dlopen"));
  return name && std::strstr(name, "openxr_loader") ? nullptr : open(name, flags);
}
