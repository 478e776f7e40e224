// The part of sandbox.h that is a program for the kernel: which system calls the worker may make.
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <vector>

#include "import/sandbox.h"

namespace scene_analyzer::import {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;  // no filter
#endif

// Younger than our headers; the numbers are the same on all processors.
constexpr int kFchmodat2 = 452, kSetxattrat = 463, kRemovexattrat = 466;

// Refused whatever their arguments are. Numbers that a processor lacks are left out of the list there.
constexpr std::array kRefused = {
    // network
    SYS_socket, SYS_socketpair, SYS_connect, SYS_bind, SYS_listen, SYS_accept, SYS_accept4,
    SYS_io_uring_setup,
    // other programs and processes
    SYS_execve, SYS_execveat, SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_kill, SYS_tkill,
    SYS_pidfd_open, SYS_pidfd_getfd, SYS_pidfd_send_signal, SYS_setns, SYS_unshare, SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo, SYS_setpriority, SYS_ioprio_set, SYS_sched_setaffinity, SYS_sched_setscheduler,
    SYS_sched_setparam, SYS_sched_setattr, SYS_shmget, SYS_shmat, SYS_msgget, SYS_semget, SYS_mq_open,
    SYS_mq_unlink,
#ifdef SYS_fork
    SYS_fork, SYS_vfork,
#endif
    // files
    SYS_unlinkat, SYS_renameat2, SYS_mkdirat, SYS_symlinkat, SYS_linkat, SYS_mknodat, SYS_truncate,
    SYS_fchmodat, SYS_fchownat, SYS_utimensat, SYS_setxattr, SYS_lsetxattr, SYS_fsetxattr, SYS_removexattr,
    SYS_lremovexattr, SYS_fremovexattr, SYS_mount, SYS_umount2, SYS_chroot, SYS_openat2,
    SYS_open_by_handle_at, SYS_fchmod, SYS_fchown,
#ifdef SYS_open
    SYS_unlink, SYS_rename, SYS_mkdir, SYS_rmdir, SYS_symlink, SYS_link, SYS_mknod, SYS_creat, SYS_chmod,
    SYS_chown, SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat,
#endif
#ifdef SYS_renameat
    SYS_renameat,
#endif
    // the kernel itself
    kFchmodat2, kSetxattrat, kRemovexattrat, SYS_bpf, SYS_perf_event_open, SYS_userfaultfd, SYS_add_key,
    SYS_keyctl, SYS_request_key};

constexpr std::uint32_t kAllow = SECCOMP_RET_ALLOW;
constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EACCES;
constexpr std::uint32_t kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;

constexpr std::uint32_t argument(std::size_t index) {
  return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + index * sizeof(std::uint64_t));
}

class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    // Calls of another architecture have other numbers.
    jump(BPF_JEQ, kArchitecture, 1, 0);
    end(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
#ifdef __x86_64__
    constexpr std::uint32_t kSecondTable = 0x40000000;  // the same calls again, for 32-bit pointers
    jump(BPF_JGE, kSecondTable, 0, 1);
    end(kRefuse);
#endif
  }

  void refuse(long call) {
    jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, 1);
    end(kRefuse);
  }
  // `call` with any of `flags` in an argument.
  void refuse_flags(long call, std::size_t index, std::uint32_t flags) {
    jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, 4);
    load(argument(index));
    jump(BPF_JSET, flags, 0, 1);
    end(kRefuse);
    end(kAllow);
  }
  // `call` whose first argument is neither 0 nor `own`.
  void refuse_others(long call, std::uint32_t own) {
    jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, 5);
    load(argument(0));
    jump(BPF_JEQ, own, 2, 0);
    jump(BPF_JEQ, 0, 1, 0);
    end(kRefuse);
    end(kAllow);
  }
  // Threads are made, processes are not. The flags of clone3 lie in memory, out of a filter's reach: without
  // it the C library takes clone.
  void refuse_processes() {
    jump(BPF_JEQ, SYS_clone3, 0, 1);
    end(SECCOMP_RET_ERRNO | ENOSYS);
    jump(BPF_JEQ, SYS_clone, 0, 4);
    load(argument(0));
    jump(BPF_JSET, CLONE_THREAD, 1, 0);
    end(kRefuse);
    end(kAllow);
  }

  void apply() {
    end(kAllow);
    const sock_fprog program{static_cast<unsigned short>(steps_.size()), steps_.data()};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
        ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program) == 0)
      return;
    // A kernel of another make may know the name and not the thing.
    if (errno != EINVAL && errno != ENOSYS)
      throw std::system_error(errno, std::generic_category(), "restricting the import worker");
  }

 private:
  void load(std::size_t offset) {
    steps_.push_back({BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)});
  }
  void jump(std::uint16_t test, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
    steps_.push_back({static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), if_true, if_false, value});
  }
  void end(std::uint32_t with) {
    steps_.push_back({BPF_RET | BPF_K, 0, 0, with});
  }

  std::vector<sock_filter> steps_;
};

}  // namespace

void allow_computing_only() {
  if (kArchitecture == 0 || !offered_by_kernel().seccomp) return;
  Filter filter;
  for (const long call : kRefused) filter.refuse(call);
  filter.refuse_processes();
#ifdef SYS_open
  filter.refuse_flags(SYS_open, 1, kWriting);
#endif
  filter.refuse_flags(SYS_openat, 2, kWriting);
  const auto own = static_cast<std::uint32_t>(::getpid());
  filter.refuse_others(SYS_tgkill, own);  // abort() sends one to itself
  filter.refuse_others(SYS_prlimit64, own);
  filter.apply();
}

}  // namespace scene_analyzer::import
