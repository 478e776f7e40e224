// importer.cpp — Damaged assets through the import worker, and some of them through the whole program.
//
//   fuzz_importer [--mutations N] [--seconds S] [--seed N] [--keep FOLDER]
//
// Each asset ends within its limits in a scene that keeps its promises or in one sentence; nothing is left
// behind: no process, no descriptor, no file. Prints counts per outcome. An asset that breaks a promise is
// kept in FOLDER (default: the working folder), and the exit code is 1. One mutation in ten goes through
// `analyze` as well, whose exit code has to be 0 or 3 and whose JSON has to hold numbers.
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "asset_seeds.h"
#include "base/error.h"
#include "cli/run_program.h"
#include "import/import.h"
#include "import/wire_builder.h"
#include "mutate.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kSecondsEach = 10;
constexpr double kGrace = 20;  // for a busy machine to start and to kill a process
const import::Limits kLimits{.memory_bytes = std::uint64_t{1} << 30, .seconds = kSecondsEach};
constexpr std::size_t kLongestReason = 600;  // bytes, beyond the file's name

struct Request {
  std::uint64_t mutations = 100, seed = 1;
  double seconds = 1e9;
  fs::path keep = ".";
};

class BrokenPromise : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

void demand(bool holds, const std::string& promise) {
  if (!holds) throw BrokenPromise(promise);
}

std::size_t open_descriptors() {
  const fs::directory_iterator folder("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(folder), end(folder)));
}

std::string kind_of(const std::string& reason) {
  if (reason.find("crashed") != std::string::npos) return "crashes of the worker";
  if (reason.find("longer than the limit") != std::string::npos) return "beyond the time limit";
  if (reason.find("more than the limit") != std::string::npos) return "beyond the memory limit";
  return "refused";
}

void check_reason(const std::string& reason, const fs::path& asset) {
  demand(reason.starts_with(asset.string() + ": "), "a reason begins with the file: " + reason);
  demand(reason.find('\n') == std::string::npos, "a reason is one line: " + reason);
  demand(reason.size() < asset.string().size() + kLongestReason, "a reason is short: " + reason);
  demand(reason.find("no usable answer") == std::string::npos, "our own worker answers: " + reason);
  demand(reason.find("json.exception") == std::string::npos, "no library's inner words: " + reason);
}

void check_scene(const mesh::Scene& scene) {
  import::touch(scene);
  for (const mesh::TriangleMesh& mesh : scene.meshes)
    for (const std::uint32_t index : mesh.indices)
      demand(index < mesh.vertex_count(), "indices name vertices");
  demand(!scene.files.empty(), "the asset is listed");
}

std::string import(const fs::path& asset) {
  const auto start = Clock::now();
  std::string outcome = "scenes";
  try {
    check_scene(import::import_asset(asset, kLimits));
  } catch (const InputError& error) {
    check_reason(error.what(), asset);
    outcome = kind_of(error.what());
  }
  const std::chrono::duration<double> seconds = Clock::now() - start;
  demand(seconds.count() < kSecondsEach + kGrace, "an import ends at its time limit");
  return outcome;
}

// JSON cannot say NaN: what parses holds numbers and nulls.
std::string analyze(const fs::path& asset) {
  const ProgramResult result =
      run_program({"analyze", "--no-cache", "--metrics", "polygons_per_planar_group", "--import-memory", "1G",
                   "--import-timeout", "10", "--json", "-", "--", asset.string()});
  const auto errors = lines_with(result.err, "error: ");
  demand(result.exit_code == 0 || result.exit_code == 3,
         "the program ends with 0 or 3, not " + std::to_string(result.exit_code) + ": " + result.err);
  demand(errors.size() == (result.exit_code == 0 ? 0 : 1), "one reason for one asset: " + result.err);
  demand(nlohmann::json::accept(result.out), "JSON comes out");
  return result.exit_code == 0 ? "analysed" : "not analysed, one reason";
}

class Fuzzer {
 public:
  explicit Fuzzer(const Request& request) : request_(request), seeds_(seed_assets()), random_(request.seed) {}

  int run() {
    for (const SeedAsset& seed : seeds_) try_one(seed, true);
    descriptors_ = open_descriptors();
    const auto end = Clock::now() + std::chrono::duration<double>(request_.seconds);
    for (; mutations_ < request_.mutations && Clock::now() < end; ++mutations_) {
      SeedAsset asset = seeds_[random_() % seeds_.size()];
      asset.bytes = mutate(asset.bytes, random_);
      try_one(asset, mutations_ % 10 == 0);
    }
    std::printf("%zu seeds, %llu mutations:", seeds_.size(), static_cast<unsigned long long>(mutations_));
    for (const auto& [what, count] : counts_) std::printf(" %zu %s,", count, what.c_str());
    std::printf(" %zu broken promises\n", broken_);
    return broken_ == 0 ? 0 : 1;
  }

 private:
  void try_one(const SeedAsset& seed, bool whole_program) {
    const TemporaryFolder folder;
    const fs::path asset = folder.write("asset" + seed.extension, seed.bytes);
    try {
      const std::string outcome = import(asset);
      ++counts_[outcome];
      if (mutations_ == 0 && descriptors_ == 0)
        demand(outcome == "scenes", "a seed is a scene, not " + outcome);
      if (whole_program) ++counts_[analyze(asset)];
      const auto left = std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
      demand(left == 1, "no file is left behind");
      demand(waitpid(-1, nullptr, WNOHANG) == -1, "no process is left behind");
      if (descriptors_ != 0) demand(open_descriptors() == descriptors_, "no descriptor is left open");
    } catch (const std::exception& error) {
      ++broken_;
      const fs::path kept = request_.keep / ("broken-" + std::to_string(broken_) + seed.extension);
      std::ofstream(kept, std::ios::binary) << seed.bytes;
      std::fprintf(stderr, "%s: %s\n", kept.c_str(), error.what());
    }
  }

  const Request request_;
  const std::vector<SeedAsset> seeds_;
  std::mt19937_64 random_;
  std::uint64_t mutations_ = 0;
  std::size_t descriptors_ = 0, broken_ = 0;
  std::map<std::string, std::size_t> counts_;
};

Request read_request(int argc, char** argv) {
  Request request;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i], value = argv[i + 1];
    if (option == "--mutations")
      request.mutations = std::stoull(value);
    else if (option == "--seconds")
      request.seconds = std::stod(value);
    else if (option == "--seed")
      request.seed = std::stoull(value);
    else if (option == "--keep")
      request.keep = value;
    else
      throw std::runtime_error("unknown option " + option);
  }
  if (argc % 2 == 0) throw std::runtime_error("every option has a value");
  return request;
}

}  // namespace
}  // namespace scene_analyzer::fuzz

int main(int argc, char** argv) {
  namespace sa = scene_analyzer;
  if (argc > 1 && std::string_view(argv[1]) == sa::import::kWorkerArgument)
    return sa::import::worker_main(argc, argv);
  try {
    return sa::fuzz::Fuzzer(sa::fuzz::read_request(argc, argv)).run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
