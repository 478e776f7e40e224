#include "service/metrics.h"

#include <fmt/format.h>
#include <prometheus/collectable.h>
#include <prometheus/counter.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <utility>
#include <vector>

#include "base/version.h"
#include "service/metrics_server.h"

namespace scene_analyzer::service {
namespace {

using prometheus::Histogram;

const Histogram::BucketBoundaries kSeconds = {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25,
                                              0.5,   1,      2.5,   5,    10,    30,   60,  300};
const Histogram::BucketBoundaries kRequestsPerPack = {1, 2, 4, 8, 16, 32, 64};

prometheus::Counter& counter(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry).Add({});
}

}  // namespace

// Gauges of what is known elsewhere.
class Metrics::LevelCollector final : public prometheus::Collectable {
 public:
  explicit LevelCollector(std::function<Levels()> levels) : levels_(std::move(levels)) {}

  std::vector<prometheus::MetricFamily> Collect() const override {
    const Levels now = levels_();
    return {gauge("scene_analyzer_requests_admitted", "Requests between their first byte and their answer",
                  now.admitted),
            gauge("scene_analyzer_requests_waiting", "Requests that wait for an import worker", now.waiting),
            gauge("scene_analyzer_requests_ready", "Requests that are imported and wait for the device",
                  now.ready),
            gauge("scene_analyzer_upload_bytes", "Bytes of uploads on the disk", now.upload_bytes),
            gauge("scene_analyzer_stored_analyses", "Analyses in the store", now.stored_analyses),
            gauge("scene_analyzer_stored_bytes", "Bytes of analyses in the store", now.stored_bytes)};
  }

 private:
  static prometheus::MetricFamily gauge(const char* name, const char* help, std::uint64_t value) {
    prometheus::MetricFamily family;
    family.name = name;
    family.help = help;
    family.type = prometheus::MetricType::Gauge;
    family.metric.resize(1);
    family.metric[0].gauge.value = static_cast<double>(value);
    return family;
  }

  const std::function<Levels()> levels_;
};

struct Metrics::Families {
  std::shared_ptr<prometheus::Registry> registry = std::make_shared<prometheus::Registry>();
  prometheus::Family<prometheus::Counter>& requests =
      prometheus::BuildCounter()
          .Name("scene_analyzer_requests_total")
          .Help("Calls that have ended, by method and status code")
          .Register(*registry);
  prometheus::Family<Histogram>& durations = prometheus::BuildHistogram()
                                                 .Name("scene_analyzer_request_seconds")
                                                 .Help("From the first byte of a call to its end, by method")
                                                 .Register(*registry);
  prometheus::Family<prometheus::Counter>& failures =
      prometheus::BuildCounter()
          .Name("scene_analyzer_failures_total")
          .Help("Calls that were refused or failed, by reason")
          .Register(*registry);
  prometheus::Histogram& packs = prometheus::BuildHistogram()
                                     .Name("scene_analyzer_pack_requests")
                                     .Help("Requests that went to the device together")
                                     .Register(*registry)
                                     .Add({}, kRequestsPerPack);
  prometheus::Counter& device_seconds = counter(*registry, "scene_analyzer_device_busy_seconds_total",
                                                "Time in which the device's thread worked");
  prometheus::Counter& triangles = counter(*registry, "scene_analyzer_triangles_total",
                                           "Triangles that were measured, each geometry once");
  prometheus::Counter& from_store = counter(*registry, "scene_analyzer_answers_from_store_total",
                                            "Analyses that were answered from the store");
  prometheus::Counter& losses =
      counter(*registry, "scene_analyzer_device_losses_total", "Devices that were lost");
  prometheus::Counter& upload_bytes =
      counter(*registry, "scene_analyzer_upload_bytes_total", "Bytes that clients have sent as files");

  Families() {
    prometheus::BuildGauge()
        .Name("scene_analyzer_info")
        .Help("The version, as a label")
        .Register(*registry)
        .Add({{"version", std::string(version())}})
        .Set(1);
    // Series that may never come about are there with 0: a rate over them is then defined.
    for (std::size_t i = 0; i < kReasonCount; ++i)
      failures.Add({{"reason", to_string(static_cast<Reason>(i))}});
  }
};

Metrics::Metrics(std::function<Levels()> levels)
    : families_(std::make_unique<Families>()), levels_(std::make_shared<LevelCollector>(std::move(levels))) {}

Metrics::~Metrics() = default;

int Metrics::listen(const std::string& address) {
  server_ = std::make_unique<MetricsServer>(
      address, std::vector<std::shared_ptr<prometheus::Collectable>>{families_->registry, levels_});
  return server_->port();
}

void Metrics::stop_listening() {
  server_.reset();
}

void Metrics::count_request(const char* method, const char* code, double seconds) {
  families_->requests.Add({{"method", method}, {"code", code}}).Increment();
  families_->durations.Add({{"method", method}}, kSeconds).Observe(seconds);
}

void Metrics::count_failure(Reason reason) {
  families_->failures.Add({{"reason", to_string(reason)}}).Increment();
}

void Metrics::add_device_seconds(double seconds) {
  families_->device_seconds.Increment(seconds);
}

void Metrics::count_pack(std::uint64_t requests) {
  families_->packs.Observe(static_cast<double>(requests));
}

void Metrics::count_triangles(std::uint64_t triangles) {
  families_->triangles.Increment(static_cast<double>(triangles));
}

void Metrics::count_answer_from_store() {
  families_->from_store.Increment();
}

void Metrics::count_device_loss() {
  families_->losses.Increment();
}

void Metrics::add_upload_bytes(std::uint64_t bytes) {
  families_->upload_bytes.Increment(static_cast<double>(bytes));
}

}  // namespace scene_analyzer::service
