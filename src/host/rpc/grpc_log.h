// grpc_log.h — What gRPC itself has to say, mostly about connections that failed.
#pragma once

#include <functional>
#include <string>

namespace scene_analyzer::rpc {

// From now on to `log`, any thread's, in place of standard error; errors only. Once per process.
void forward_grpc_log(std::function<void(const std::string& message)> log);

}  // namespace scene_analyzer::rpc
