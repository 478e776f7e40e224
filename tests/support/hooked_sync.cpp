#include "support/hooked_sync.h"

#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace scene_analyzer {
namespace {

SyncHook current_hook;

}  // namespace

HookedSync::HookedSync(SyncHook hook) {
  current_hook = std::move(hook);
}
HookedSync::~HookedSync() {
  current_hook = nullptr;
}

}  // namespace scene_analyzer

// Takes the place of the C library's for the whole program.
extern "C" int fsync(int descriptor) {
  using scene_analyzer::current_hook;
  struct stat status {};
  if (current_hook && ::fstat(descriptor, &status) == 0)
    if (const int error = current_hook(S_ISDIR(status.st_mode))) {
      errno = error;
      return -1;
    }
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}
