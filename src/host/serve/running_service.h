// running_service.h — Everything a service consists of, from its device to its network address.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "cli/lazy_device.h"
#include "rpc/server.h"
#include "serve/serve_options.h"

namespace scene_analyzer::serve {

class RunningService {
 public:
  // Serves when it returns. Throws UsageError and gpu::NoDevice for what cannot be had.
  RunningService(const ServeRequest& request, cli::LazyDevice& device);
  ~RunningService() = default;  // whatever is not answered is cancelled
  RunningService(const RunningService&) = delete;
  RunningService& operator=(const RunningService&) = delete;

  const std::string& address() const { return server_->address(); }
  std::string device_name();
  // Logs what is wrong with it; the tokens stay as they were then.
  void reload_tokens();
  // Says that it does not serve any more, and takes no request from now on.
  void begin_to_drain();
  // Whether every request that was taken has its answer, before `time` is over.
  bool wait_for_answers(std::chrono::milliseconds time);
  // Sends what is on its way to clients; to be called when every request has its answer.
  void hang_up();

 private:
  void start_executor(unsigned jobs, cli::LazyDevice& device);
  service::Levels levels() const;

  // A scrape asks the executor: none comes once it is gone, also where the service does not get to serve.
  struct Scrapes {
    explicit Scrapes(service::Metrics& asked) : metrics(asked) {}
    ~Scrapes() { metrics.stop_listening(); }
    Scrapes(const Scrapes&) = delete;
    Scrapes& operator=(const Scrapes&) = delete;
    service::Metrics& metrics;
  };

  bool device_asked_ = false;
  std::shared_ptr<service::ContentStore> store_;
  std::optional<service::RootFolder> root_;
  std::optional<service::TokenList> tokens_;
  service::UploadSpace uploads_;
  service::Admission admission_;
  service::Metrics metrics_;
  std::optional<service::Executor> executor_;
  std::optional<rpc::Backend> backend_;
  std::optional<Scrapes> scrapes_;
  std::optional<rpc::Server> server_;  // last: calls use the others
};

}  // namespace scene_analyzer::serve
