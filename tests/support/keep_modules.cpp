// Keeps drivers and validation layers loaded to the end of a sanitizer run. They are unloaded with the last
// Vulkan instance; what they never freed would then be a leak without a name, which tests/lsan.supp could not
// tell from ours.
extern "C" int dlclose(void*) {
  return 0;
}
