// main() of test binaries that import assets: when the import room re-executes the binary, it is the worker.
//
// SCENE_ANALYZER_TEST_WORKER makes the worker misbehave: "crash", "hang", "exit", "silence", "garbage";
// "bytes" (the asset's bytes are the answer), "probe" (the answer names what a confined worker could still
// do).
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "import/import.h"
#include "import/sandbox.h"
#include "import/wire.h"
#include "import/worker_process.h"

namespace {

namespace import = scene_analyzer::import;

bool opens(const char* path, int flags) {
  const int file = open(path, flags | O_CLOEXEC, 0600);
  if (file >= 0) close(file);
  return file >= 0;
}

bool forks() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  return child > 0;
}

std::uint64_t limit_of(__rlimit_resource resource) {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 ? limit.rlim_cur : 0;
}

// What should be impossible and is not, one word each, behind the same for what should be possible.
std::string probe_files(const std::string& asset) {
  std::string found;
  if (!opens(asset.c_str(), O_RDONLY)) found += " asset-unreadable";
  if (opens("/etc/passwd", O_RDONLY)) found += " reads-elsewhere";
  if (opens("new-file", O_WRONLY | O_CREAT)) found += " creates-files";
  if (opens(asset.c_str(), O_RDWR)) found += " writes-files";
  if (unlink(asset.c_str()) == 0) found += " removes-files";
  if (truncate(asset.c_str(), 0) == 0) found += " truncates-files";
  if (lsetxattr(asset.c_str(), "user.note", "x", 1, 0) == 0 || errno != EACCES)
    found += " changes-attributes";
  return found;
}

std::string probe_processes() {
  std::string found;
  for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK})
    if (socket(family, SOCK_DGRAM, 0) >= 0) found += " opens-sockets";
  if (forks()) found += " forks";
  char* const nothing[] = {nullptr};
  if (execve("/bin/true", nothing, nothing) == 0 || errno != EACCES) found += " executes";
  if (kill(getppid(), 0) == 0) found += " signals-others";
  siginfo_t signal{};
  signal.si_code = SI_QUEUE;
  if (syscall(SYS_rt_sigqueueinfo, getppid(), 0, &signal) == 0) found += " queues-signals";
  if (setpriority(PRIO_PROCESS, static_cast<id_t>(getppid()), 0) == 0) found += " hurries-others";
  if (limit_of(RLIMIT_CORE) != 0) found += " dumps-core";
#ifndef __SANITIZE_ADDRESS__
  if (limit_of(RLIMIT_AS) == RLIM_INFINITY) found += " no-memory-limit";
#endif
  if (limit_of(RLIMIT_CPU) == RLIM_INFINITY || limit_of(RLIMIT_FSIZE) == RLIM_INFINITY) found += " no-limit";
  for (int descriptor = import::kAnswerDescriptor + 1; descriptor < 4096; ++descriptor)
    if (fcntl(descriptor, F_GETFD) >= 0) found += " open-descriptor";
  return found;
}

[[noreturn]] void probe(char** argv) {
  const std::filesystem::path asset = argv[2];
  std::filesystem::current_path(asset.parent_path());
  import::limit_this_process(std::stoull(argv[3]), 60, getppid());
  import::allow_reading_only(".", asset.filename());
  import::allow_computing_only();
  import::wire::Writer writer(import::kAnswerDescriptor);
  writer.string("probe:" + probe_files(asset.filename().string()) + probe_processes());
  writer.finish(import::wire::Status::kRefused);
  _exit(0);  // at a usual end LeakSanitizer would want another process
}

int answer_bytes(const char* asset) {
  std::ifstream stream(asset, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return write(import::kAnswerDescriptor, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size())
             ? 0
             : 1;
}

int misbehave(std::string_view how, char** argv) {
  if (how == "probe") probe(argv);
  if (how == "bytes") return answer_bytes(argv[2]);
  signal(SIGSEGV, SIG_DFL);  // AddressSanitizer would turn it into an exit code
  if (how == "crash") raise(SIGSEGV);
  while (how == "hang") pause();
  if (how == "garbage" && write(scene_analyzer::import::kAnswerDescriptor, "nonsense", 8) != 8) return 1;
  return how == "exit" ? 42 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == scene_analyzer::import::kWorkerArgument) {
    const char* how = std::getenv("SCENE_ANALYZER_TEST_WORKER");
    return how != nullptr ? misbehave(how, argv) : scene_analyzer::import::worker_main(argc, argv);
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
