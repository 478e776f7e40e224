// Clients of a running service, for bench/service.py:
//
//   scene-analyzer-bench-service write FOLDER FIRST COUNT             assets FIRST, FIRST + 1, ... as files
//   scene-analyzer-bench-service load ADDRESS CLIENTS FIRST COUNT     the same as requests of several clients
//   scene-analyzer-bench-service latency ADDRESS FIRST COUNT          one after the other, each also in this process
//
// Prints one line of JSON. Every answer's number of triangles is checked. Asset i is an uneven grid of 64 to
// 127 triangles, of which no two are alike, so that no answer comes from a store.
#include <fmt/format.h>
#include <grpcpp/grpcpp.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "gpu/device.h"
#include "import/import.h"
#include "pipeline/pipeline.h"
#include "scene_analyzer/v1/service.grpc.pb.h"

namespace scene_analyzer::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kRows = 4;

std::uint64_t columns_of(std::uint64_t asset) {
  return 8 + asset % 8;
}

std::uint64_t triangles_of(std::uint64_t asset) {
  return 2 * kRows * columns_of(asset);
}

std::string name_of(std::uint64_t asset) {
  return fmt::format("asset-{}.ply", asset);
}

// PLY, because Assimp's importer of OBJ fills 16 MiB before it reads the first byte.
std::string ply_of(std::uint64_t asset) {
  const std::uint64_t columns = columns_of(asset);
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment asset {}\nelement vertex {}\nproperty float x\nproperty float "
      "y\nproperty float "
      "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      asset, (columns + 1) * (kRows + 1), triangles_of(asset));
  for (std::uint64_t y = 0; y <= kRows; ++y)
    for (std::uint64_t x = 0; x <= columns; ++x)
      text += fmt::format("{} {} {}\n", x, y, static_cast<double>((asset + 7 * x + 3 * y * y) % 101) / 50);
  for (std::uint64_t y = 0; y < kRows; ++y)
    for (std::uint64_t x = 0; x < columns; ++x) {
      const std::uint64_t corner = y * (columns + 1) + x, above = corner + columns + 1;
      text += fmt::format("3 {0} {1} {3}\n3 {0} {3} {2}\n", corner, corner + 1, above, above + 1);
    }
  return text;
}

// Throws when the answer is not that asset's.
void ask(v1::SceneAnalyzer::Stub& stub, std::uint64_t asset) {
  grpc::ClientContext context;
  const auto stream = stub.Analyze(&context);
  v1::AnalyzeRequest request;
  request.mutable_parameters();
  stream->Write(request);
  request.mutable_file()->set_name(name_of(asset));
  stream->Write(request);
  request.set_data(ply_of(asset));
  stream->Write(request);
  stream->WritesDone();
  v1::AnalyzeResponse response;
  while (stream->Read(&response)) {
  }
  const grpc::Status status = stream->Finish();
  if (!status.ok()) throw std::runtime_error(status.error_message());
  if (response.result().from_store() || response.result().analysis().geometries_size() != 1 ||
      response.result().analysis().geometries(0).triangles() != triangles_of(asset))
    throw std::runtime_error("the answer is not that of the asset");
}

std::unique_ptr<v1::SceneAnalyzer::Stub> connect(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // a connection for each
  return v1::SceneAnalyzer::NewStub(
      grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments));
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void load(const std::string& address, std::uint64_t clients, std::uint64_t first, std::uint64_t count) {
  std::atomic<std::uint64_t> next = first;
  std::atomic<bool> failed = false;
  const auto begin = Clock::now();
  {
    std::vector<std::jthread> threads;
    for (std::uint64_t i = 0; i < clients; ++i)
      threads.emplace_back([&] {
        const auto stub = connect(address);
        for (std::uint64_t asset = next++; asset < first + count && !failed; asset = next++) try {
            ask(*stub, asset);
          } catch (const std::exception& error) {
            fmt::print(stderr, "asset {}: {}\n", asset, error.what());
            failed = true;
          }
      });
  }
  if (failed) throw std::runtime_error("a request has failed");
  fmt::print("{{\"seconds\": {}}}\n", seconds_since(begin));
}

void write(const fs::path& folder, std::uint64_t first, std::uint64_t count) {
  for (std::uint64_t asset = first; asset < first + count; ++asset)
    std::ofstream(folder / name_of(asset)) << ply_of(asset);
  fmt::print("{{}}\n");
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void latency(const std::string& address, std::uint64_t first, std::uint64_t count) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("scene-analyzer-bench-{}", ::getpid());
  fs::create_directories(folder);
  gpu::Device device;
  pipeline::Options options;
  options.use_analysis_files = false;
  options.fingerprint_files = true;
  options.metrics.reset(index_of(analysis::Metric::kRenderingTime));
  pipeline::Pipeline pipeline(options, [&]() -> gpu::Device& { return device; });
  const auto stub = connect(address);
  std::vector<double> here, there, added;
  for (std::uint64_t asset = first; asset < first + count; ++asset) {
    const fs::path file = folder / name_of(asset);
    auto begin = Clock::now();
    std::ofstream(file) << ply_of(asset);  // as the service has to write it
    const pipeline::Outcome outcome = pipeline.analyze(file);
    fs::remove(file);
    const double alone = seconds_since(begin);
    if (!outcome.analysis) throw std::runtime_error(outcome.error);
    begin = Clock::now();
    ask(*stub, asset);
    const double asked = seconds_since(begin);
    if (asset < first + count / 10) continue;  // kernels are made for the first ones
    here.push_back(alone);
    there.push_back(asked);
    added.push_back(asked - alone);
  }
  fs::remove_all(folder);
  fmt::print("{{\"in_process\": {}, \"service\": {}, \"added\": {}}}\n", median(here), median(there),
             median(added));
}

int run(const std::vector<std::string>& words) {
  const auto number = [&](std::size_t i) { return std::stoull(words.at(i)); };
  const std::string mode = words.at(0);
  if (mode == "write") write(words.at(1), number(2), number(3));
  if (mode == "load") load(words.at(1), number(2), number(3), number(4));
  if (mode == "latency") latency(words.at(1), number(2), number(3));
  return 0;
}

}  // namespace
}  // namespace scene_analyzer::bench

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == scene_analyzer::import::kWorkerArgument)
    return scene_analyzer::import::worker_main(argc, argv);
  try {
    return scene_analyzer::bench::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return 1;
  }
}
