// keep_libraries.cpp — Part of every program of a sanitizer build: libraries are never unloaded.
//
// The Vulkan loader closes the driver with the last instance. LeakSanitizer looks at the end of the process
// and can no longer say whose the leaks of lavapipe were, so that lsan.supp cannot name them.
extern "C" int dlclose(void*) noexcept {
  return 0;
}
