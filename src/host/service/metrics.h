// metrics.h — What the service counts, for Prometheus. docs/service.md lists the names.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "service/refusal.h"

namespace scene_analyzer::service {

// Levels that are looked up when somebody asks.
struct Levels {
  std::uint64_t admitted = 0;  // requests between their first byte and their answer
  std::uint64_t waiting = 0;   // of these, for an import worker
  std::uint64_t ready = 0;     // of these, for the device
  std::uint64_t upload_bytes = 0;
  std::uint64_t stored_analyses = 0, stored_bytes = 0;
};

class MetricsServer;

// All members may be called by any thread.
class Metrics {
 public:
  explicit Metrics(std::function<Levels()> levels);
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  // Answers http://ADDRESS/metrics from now on; port 0: any free one. Returns the port. Throws UsageError
  // when nobody can listen there.
  int listen(const std::string& address);
  // Nobody asks for levels after it.
  void stop_listening();

  void count_request(const char* method, const char* code,
                     double seconds);  // code: gRPC's name of the status
  void count_failure(Reason reason);
  void add_device_seconds(double seconds);  // in which the device's thread worked
  void count_pack(std::uint64_t requests);  // that went to the device together
  void count_triangles(std::uint64_t triangles);
  void count_answer_from_store();
  void count_device_loss();
  void add_upload_bytes(std::uint64_t bytes);

 private:
  struct Families;
  class LevelCollector;
  const std::unique_ptr<Families> families_;
  const std::shared_ptr<LevelCollector> levels_;
  std::unique_ptr<MetricsServer> server_;
};

}  // namespace scene_analyzer::service
