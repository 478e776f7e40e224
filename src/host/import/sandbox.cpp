#include "import/sandbox.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace scene_analyzer::import {
namespace {

[[noreturn]] void throw_system_error(const char* doing) {
  throw std::system_error(errno, std::generic_category(), doing);
}

// `hard` above `soft` leaves room for the signal that tells which limit it was.
void limit(__rlimit_resource resource, std::uint64_t soft, std::uint64_t hard) {
  rlimit current{};
  if (::getrlimit(resource, &current) != 0) throw_system_error("reading a limit");
  hard = std::min<std::uint64_t>(hard, current.rlim_max);
  const rlimit wanted{std::min(soft, hard), hard};
  if (::setrlimit(resource, &wanted) != 0) throw_system_error("setting a limit");
}

// Everything the first version of Landlock knows: reading, writing, executing, making and removing.
constexpr std::uint64_t kHandled = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
constexpr std::uint64_t kTruncate = std::uint64_t{1} << 14;  // of its third version; younger than our headers
constexpr std::uint64_t kReadFile = LANDLOCK_ACCESS_FS_READ_FILE;
constexpr std::uint64_t kReadFolder = kReadFile | LANDLOCK_ACCESS_FS_READ_DIR;

void allow(int rules, const std::filesystem::path& path, std::uint64_t access) {
  const int target = ::open(path.c_str(), O_PATH | O_CLOEXEC);
  if (target < 0) throw_system_error("opening the asset's folder");
  const landlock_path_beneath_attr rule{access, target};
  const long added = ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  ::close(target);
  if (added != 0) throw_system_error("restricting the import worker");
}

// 0 where the kernel has none, or whoever started us forbids it.
long landlock_version() noexcept {
  return std::max(0L, ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
}

// Where the whole machine runs out of memory, the worker is to go and not the program that it works for.
// Where there is no such file, the system decides as it likes.
void offer_to_be_killed_first() {
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(file, "1000", 4);
  ::close(file);
}

}  // namespace

Offered offered_by_kernel() noexcept {
  Offered offered;
  offered.landlock = landlock_version() > 0;
  const std::uint32_t action = SECCOMP_RET_ERRNO;
  offered.seccomp = ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
  return offered;
}

void limit_this_process(std::uint64_t memory_bytes, std::uint64_t cpu_seconds, pid_t parent) {
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) throw_system_error("tying the import worker to its parent");
  if (::getppid() != parent) ::_exit(1);  // it died before the line above
#ifndef __SANITIZE_ADDRESS__
  limit(RLIMIT_AS, memory_bytes, memory_bytes);
#endif
  // The answer lies in memory too, and no address space is needed to write it.
  limit(RLIMIT_FSIZE, memory_bytes, memory_bytes);
  limit(RLIMIT_CPU, cpu_seconds, cpu_seconds + 5);
  limit(RLIMIT_CORE, 0, 0);
  offer_to_be_killed_first();
}

void allow_reading_only(const std::filesystem::path& folder, const std::filesystem::path& asset) {
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) throw_system_error("restricting the import worker");
  const long known = landlock_version();
  if (known == 0) return;
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = kHandled | (known >= 3 ? kTruncate : 0);
  const int rules = static_cast<int>(
      ::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes.handled_access_fs, 0));
  if (rules < 0) throw_system_error("restricting the import worker");
  allow(rules, folder, kReadFolder);
  allow(rules, asset, kReadFile);
  if (::syscall(SYS_landlock_restrict_self, rules, 0) != 0)
    throw_system_error("restricting the import worker");
  ::close(rules);
}

}  // namespace scene_analyzer::import
