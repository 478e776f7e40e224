// main.cpp — The program `scene-analyzer-serve`, which `scene-analyzer serve` becomes.
#include <string>
#include <vector>

#include "cli/run_command.h"
#include "import/import.h"
#include "serve/serve_command.h"

int main(int argc, char** argv) {
  // First of all, as in cli/main.cpp.
  if (argc > 1 && std::string(argv[1]) == scene_analyzer::import::kWorkerArgument)
    return scene_analyzer::import::worker_main(argc, argv);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return scene_analyzer::cli::run_command([&] { return scene_analyzer::serve::serve_command(arguments); });
}
