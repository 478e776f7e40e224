// hooked_sync.h — A test binary's own fsync(): a test can watch it, and make it fail as a dying disk does.
// Binaries that use it list ../support/hooked_sync.cpp among their sources.
#pragma once

#include <functional>

namespace scene_analyzer {

// Called before every fsync(), told whether a folder's; what it returns becomes errno, and 0 lets the system
// do it.
using SyncHook = std::function<int(bool of_folder)>;

// The hook in use as long as the object lives.
class HookedSync {
 public:
  explicit HookedSync(SyncHook hook);
  ~HookedSync();
  HookedSync(const HookedSync&) = delete;
  HookedSync& operator=(const HookedSync&) = delete;
};

}  // namespace scene_analyzer
