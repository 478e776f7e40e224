// call.h — What every call has in common: who asks, under which id, and how it ends.
#pragma once

#include <grpcpp/grpcpp.h>

#include <cstddef>
#include <functional>
#include <string>

#include "rpc/backend.h"

namespace scene_analyzer::rpc {

// What is said of a message that is none, or of another kind.
inline constexpr const char* kCannotBeParsed =
    "a message cannot be parsed; are its names UTF-8, and is the .proto the same?";

// Data of files come in messages of at most 4 MiB; analyses for Rate may be larger.
inline constexpr std::size_t kMostMessageBytes = 32 << 20;
// Throws service::Refusal for a message beyond it.
void check_size(std::size_t message_bytes);

class Call {
 public:
  Call(Backend& backend, const char* method, grpc::ServerContext& context);

  // Answers with what `work` makes of it: OK, or the status of the service::Refusal that it throws. Whoever
  // has no valid token is refused before. Anything else that is thrown is a defect: INTERNAL, told to the log
  // only.
  grpc::Status run(const std::function<void()>& work);

  grpc::ServerContext& context() { return context_; }
  CallRecord& record() { return record_; }
  // Throws service::Refusal when nobody waits for the answer.
  void check_cancelled() const;

 private:
  void check_token() const;
  grpc::Status attempt(const std::function<void()>& work);
  grpc::Status refuse(const service::Refusal& refusal);

  Backend& backend_;
  grpc::ServerContext& context_;
  CallRecord record_;
};

}  // namespace scene_analyzer::rpc
