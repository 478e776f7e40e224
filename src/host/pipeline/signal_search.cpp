#include "pipeline/signal_search.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace scene_analyzer::pipeline {
namespace {

constexpr std::chrono::milliseconds kBetweenReports(200);

}  // namespace

SignalSearch::~SignalSearch() {
  stop_.request_stop();
  if (result_.valid()) result_.wait();
}

void SignalSearch::start(surface_distances::BatchSurfaces surfaces, const PlannedBatch& plan,
                         std::uint64_t most_searches) {
  surfaces_ = std::move(surfaces);
  result_ = std::async(std::launch::async, [this, &plan, most_searches] {
    std::vector<surface_distances::MeshSurface> meshes;
    for (std::size_t mesh = 0; mesh < plan.batch.meshes.size(); ++mesh)
      meshes.push_back(surfaces_.surface(mesh, *plan.batch.meshes[mesh].mesh));
    const surface_distances::SignalOptions options{
        .most_searches = most_searches,
        .threads = std::max(1U, std::thread::hardware_concurrency()),
        .stop = stop_.get_token(),
        .progress = [this](double fraction) { done_ = fraction; }};
    return surface_distances::measure_signals(meshes, options);
  });
}

bool SignalSearch::is_running() const {
  return started() && result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

std::vector<surface_distances::Signal> SignalSearch::finish(
    const std::function<void(double fraction)>& progress) {
  while (result_.wait_for(kBetweenReports) != std::future_status::ready) progress(done_);
  return result_.get();
}

}  // namespace scene_analyzer::pipeline
