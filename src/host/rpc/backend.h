// backend.h — What calls are answered with.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "pipeline/pipeline.h"
#include "service/admission.h"
#include "service/content_store.h"
#include "service/executor.h"
#include "service/metrics.h"
#include "service/root_folder.h"
#include "service/token_list.h"
#include "service/uploads.h"

namespace scene_analyzer::rpc {

// One call that has ended, for the log.
struct CallRecord {
  std::string method;  // "Analyze"
  std::string request_id;
  std::string peer;   // "ipv4:127.0.0.1:40312"
  std::string asset;  // where there was one
  std::uint64_t upload_bytes = 0;
  bool from_store = false;
  std::string code;     // "OK", "INVALID_ARGUMENT"
  std::string message;  // of the status
  double seconds = 0;
};

struct Limits {
  std::uint64_t upload_bytes = std::uint64_t{1} << 30;                   // of one request
  double timing_budget = 30;                                             // seconds, of one request
  std::uint64_t start_searches = analysis::Parameters().start_searches;  // of one request
  import::Limits import;
  std::chrono::seconds silence{60};  // for how long a client may neither send nor read what it is expected to
};

struct Backend {
  service::Executor& executor;
  service::Admission& admission;
  service::UploadSpace& uploads;
  service::Metrics& metrics;
  std::shared_ptr<service::ContentStore> store;  // or none
  const service::RootFolder* root = nullptr;     // or none
  const service::TokenList* tokens = nullptr;    // or none: everybody may ask
  std::vector<gpu::DeviceInfo> devices = {};     // of this machine
  Limits limits = {};
  std::function<void(const CallRecord&)> log = {};
  std::function<void(const std::string&)> log_error = {};
};

}  // namespace scene_analyzer::rpc
