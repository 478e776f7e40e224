#include "rpc/grpc_log.h"

#include <grpc/support/log.h>

#include <utility>

namespace scene_analyzer::rpc {
namespace {

// Never destroyed: threads of gRPC may outlive main().
std::function<void(const std::string&)>& sink() {
  static auto* const log = new std::function<void(const std::string&)>;
  return *log;
}

void forward(gpr_log_func_args* arguments) {
  if (arguments->severity == GPR_LOG_SEVERITY_ERROR) sink()(arguments->message);
}

}  // namespace

void forward_grpc_log(std::function<void(const std::string&)> log) {
  sink() = std::move(log);
  gpr_set_log_function(forward);
}

}  // namespace scene_analyzer::rpc
