// metrics_server.h — Metrics over HTTP, at /metrics.
#pragma once

#include <prometheus/collectable.h>
#include <prometheus/exposer.h>

#include <memory>
#include <string>
#include <vector>

namespace scene_analyzer::service {

class MetricsServer {
 public:
  // `address`: "host:port"; port 0: any free one. Throws UsageError when nobody can listen there.
  MetricsServer(const std::string& address,
                const std::vector<std::shared_ptr<prometheus::Collectable>>& collectables);
  ~MetricsServer();
  MetricsServer(const MetricsServer&) = delete;
  MetricsServer& operator=(const MetricsServer&) = delete;

  int port() const { return port_; }

 private:
  const std::string host_;
  std::unique_ptr<prometheus::Exposer> exposer_;
  int port_ = 0;
};

}  // namespace scene_analyzer::service
