// main() of test binaries that import assets: when the import room re-executes the binary, it is the worker.
//
// SCENE_ANALYZER_TEST_WORKER makes the worker misbehave: "crash", "hang", "exit", "silence", "garbage".
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "import/import.h"
#include "import/worker_process.h"

namespace {

int misbehave(std::string_view how) {
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
    return how != nullptr ? misbehave(how) : scene_analyzer::import::worker_main(argc, argv);
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
