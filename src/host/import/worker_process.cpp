#include "import/worker_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "import/wire.h"
#include "import/worker_binary.h"

namespace scene_analyzer::import {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kBetweenLooks = 0.05;  // seconds, at whether to stop

[[noreturn]] void throw_system_error(const char* doing, int error = errno) {
  throw std::system_error(error, std::generic_category(), doing);
}

class Descriptor {
 public:
  Descriptor(int value, const char* doing) : value_(value) {
    if (value < 0) throw_system_error(doing);
  }
  ~Descriptor() { ::close(value_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }

 private:
  int value_;
};

// What the child gets: no descriptor but /dev/null and the answer, no blocked or ignored signal.
class SpawnPlan {
 public:
  explicit SpawnPlan(int answer) {
    check(posix_spawn_file_actions_init(&actions_));
    check(posix_spawnattr_init(&attributes_));
    check(posix_spawn_file_actions_adddup2(&actions_, answer, kAnswerDescriptor));
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      check(posix_spawn_file_actions_addopen(&actions_, standard, "/dev/null", O_RDWR, 0));
    check(posix_spawn_file_actions_addclosefrom_np(&actions_, kAnswerDescriptor + 1));
    sigset_t signals;
    sigemptyset(&signals);
    check(posix_spawnattr_setsigmask(&attributes_, &signals));
    sigfillset(&signals);
    check(posix_spawnattr_setsigdefault(&attributes_, &signals));
    check(posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  }
  ~SpawnPlan() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  pid_t spawn(const std::string& program, std::vector<std::string> arguments) const {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    check(posix_spawn(&child, program.c_str(), &actions_, &attributes_, argv.data(), environ));
    return child;
  }

 private:
  static void check(int error) {
    if (error != 0) throw_system_error("starting the import worker", error);
  }

  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

// A running child, killed and reaped when nobody waited for it.
class Child {
 public:
  explicit Child(pid_t id) : id_(id), handle_(static_cast<int>(::syscall(SYS_pidfd_open, id, 0))) {}
  ~Child() {
    if (!reaped_) kill_and_wait();
    if (handle_ >= 0) ::close(handle_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // The wait status, or nothing when the time ran out and the child was killed. Throws Stopped.
  std::optional<int> wait_for(double seconds, const std::stop_token& stop) {
    if (handle_ < 0) throw_system_error("watching the import worker");
    const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
    while (true) {
      if (stop.stop_requested()) throw Stopped();
      double left = std::chrono::duration<double>(deadline - Clock::now()).count();
      if (stop.stop_possible()) left = std::min(left, kBetweenLooks);
      pollfd ready{handle_, POLLIN, 0};
      const int timeout = static_cast<int>(std::clamp(std::ceil(left * 1000), 0.0, 1e9));
      const int count = ::poll(&ready, 1, timeout);
      if (count > 0) return wait();
      if (count < 0 && errno != EINTR) throw_system_error("waiting for the import worker");
      if (count == 0 && Clock::now() >= deadline) break;
    }
    kill_and_wait();
    return std::nullopt;
  }

  // Largest resident memory, once it has ended by itself.
  std::uint64_t peak_bytes() const { return peak_bytes_; }

 private:
  int wait() {
    int status = 0;
    rusage usage{};
    while (::wait4(id_, &status, 0, &usage) < 0)
      if (errno != EINTR) throw_system_error("waiting for the import worker");
    reaped_ = true;
    peak_bytes_ = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return status;
  }
  void kill_and_wait() {
    ::kill(id_, SIGKILL);
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    reaped_ = true;
  }

  pid_t id_;
  int handle_;
  bool reaped_ = false;
  std::uint64_t peak_bytes_ = 0;
};

std::uint64_t whole_seconds(double seconds) {
  return static_cast<std::uint64_t>(std::clamp(std::ceil(seconds), 1.0, 1e9));
}

std::string in_units(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text + " s";
}

std::string out_of_memory(const Limits& limits) {
  return "importing it needs more than the limit of " + std::to_string(limits.memory_bytes >> 20) +
         " MiB of memory (--import-memory); the file may claim counts that it does not hold";
}

std::string out_of_time(const Limits& limits) {
  return "importing it takes longer than the limit of " + in_units(limits.seconds) + " (--import-timeout)";
}

std::string describe_signal(int signal, const Limits& limits) {
  if (signal == SIGXCPU) return out_of_time(limits);
  if (signal == SIGXFSZ) return out_of_memory(limits);
  if (signal == SIGBUS)
    return "the importer crashed (SIGBUS); did the file become shorter while it was read? Try again";
  if (signal == SIGKILL) return "the importer was killed by the system, probably for lack of memory";
  const char* abbreviation = sigabbrev_np(signal);
  return "the importer crashed (" +
         (abbreviation ? "SIG" + std::string(abbreviation) : "signal " + std::to_string(signal)) +
         "); the file is damaged or hits a defect of Assimp; export it again, or in another format";
}

Answer map(const Descriptor& memory, const mesh::ImportEffort& effort) {
  struct stat state {};
  if (::fstat(memory.get(), &state) != 0) throw_system_error("reading the import worker's answer");
  const auto bytes = static_cast<std::size_t>(state.st_size);
  if (bytes == 0) return {};
  void* address = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, memory.get(), 0);
  if (address == MAP_FAILED) throw_system_error("mapping the import worker's answer");
  std::shared_ptr<const void> owner(
      address, [bytes](const void* start) { ::munmap(const_cast<void*>(start), bytes); });
  return {owner,
          {static_cast<const std::byte*>(address), bytes},
          {effort.seconds, effort.worker_peak_bytes, bytes}};
}

// Set by the worker's allocator before it gives up, whatever it died of afterwards.
bool says_out_of_memory(const Answer& answer) {
  try {
    return wire::Reader(answer.memory).status() == wire::Status::kOutOfMemory;
  } catch (const wire::Malformed&) {
    return false;  // nothing or half an answer: the way it ended is the news
  }
}

}  // namespace

Answer run_worker(const mesh::AssetSource& asset, const Limits& limits, Textures textures) {
  const Descriptor memory(::memfd_create("imported scene", MFD_CLOEXEC | MFD_ALLOW_SEALING),
                          "making memory for the import worker");
  const auto start = Clock::now();
  Child child(SpawnPlan(memory.get())
                  .spawn(worker_program(),
                         {program_invocation_name, kWorkerArgument, asset.file.string(),
                          std::to_string(limits.memory_bytes), std::to_string(whole_seconds(limits.seconds)),
                          std::to_string(::getpid()), std::to_string(static_cast<int>(textures)),
                          std::to_string(limits.triangles), asset.file_names ? "1" : "0"}));
  const std::optional<int> status = child.wait_for(limits.seconds, limits.stop);
  if (!status) throw WorkerFailure(out_of_time(limits), true);

  constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL;
  if (::fcntl(memory.get(), F_ADD_SEALS, kSeals) != 0)
    throw_system_error("sealing the import worker's answer");
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  Answer answer = map(memory, {seconds, child.peak_bytes(), 0});
  if (says_out_of_memory(answer)) throw WorkerFailure(out_of_memory(limits));
  if (WIFSIGNALED(*status))
    throw WorkerFailure(describe_signal(WTERMSIG(*status), limits), WTERMSIG(*status) == SIGKILL);
  if (WEXITSTATUS(*status) != 0)
    throw WorkerFailure("the importer ended unexpectedly (exit code " + std::to_string(WEXITSTATUS(*status)) +
                        ")");
  return answer;
}

}  // namespace scene_analyzer::import
