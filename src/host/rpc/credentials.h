// credentials.h — Certificates as gRPC takes them.
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>

#include "rpc/server.h"

namespace scene_analyzer::rpc {

// Throws UsageError naming the option and the file: what cannot be read, is no PEM, or does not belong
// together. gRPC itself would only refuse every connection later.
std::shared_ptr<grpc::ServerCredentials> make_credentials(const std::optional<Tls>& tls);

}  // namespace scene_analyzer::rpc
