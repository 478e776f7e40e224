#include "rpc/server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>

#include <string_view>

#include "base/error.h"
#include "grpc/health/v1/health.pb.h"
#include "rpc/call.h"
#include "rpc/credentials.h"
#include "rpc/scene_analyzer_service.h"

namespace scene_analyzer::rpc {
namespace {

using namespace std::chrono_literals;

// Beyond which gRPC itself refuses a message, in its own words. Up to here check_size() says what to do, and
// that it is of no use to try again. Not much more, for it is held in memory before anything is known of it.
constexpr int kLargestMessage = kMostMessageBytes + (4 << 20);
constexpr int kCallsPerConnection = 128;
constexpr std::chrono::milliseconds kKeepaliveTime = 30s, kKeepaliveTimeout = 10s, kLeastPingInterval = 10s,
                                    kHandshakeTimeout = 10s;

// "127.0.0.1" of "127.0.0.1:50051", "::1" of "[::1]:50051".
std::string_view host_of(std::string_view address) {
  const std::size_t colon = address.rfind(':');
  std::string_view host = address.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  return host;
}

void set_channel_arguments(grpc::ServerBuilder& builder) {
  const auto milliseconds = [](std::chrono::milliseconds time) { return static_cast<int>(time.count()); };
  // Two services on one port would each get some of the calls.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kCallsPerConnection);
  // A peer that vanished without a word is noticed within 40 seconds; clients may ping as often as every 10.
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, milliseconds(kKeepaliveTime));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, milliseconds(kKeepaliveTimeout));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
                             milliseconds(kLeastPingInterval));
  // A connection that never says hello.
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, milliseconds(kHandshakeTimeout));
}

}  // namespace

bool is_loopback(const std::string& address) {
  const std::string host(host_of(address));
  in_addr v4{};
  in6_addr v6{};
  if (::inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  if (::inet_pton(AF_INET6, host.c_str(), &v6) == 1) return IN6_IS_ADDR_LOOPBACK(&v6) != 0;
  return host == "localhost";
}

struct Server::Parts {
  explicit Parts(Backend& backend) : service(backend) {}
  SceneAnalyzerService service;
  std::unique_ptr<grpc::Server> server;
};

Server::Server(const ServerOptions& options, Backend& backend) : parts_(std::make_unique<Parts>(backend)) {
  grpc::EnableDefaultHealthCheckService(true);
  grpc::health::v1::HealthCheckRequest::descriptor();  // has it linked, for reflection
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort(options.address, make_credentials(options.tls), &port);
  builder.RegisterService(&parts_->service);
  builder.SetMaxReceiveMessageSize(kLargestMessage);
  builder.SetMaxSendMessageSize(-1);  // results are as large as they are
  set_channel_arguments(builder);
  // A call that is waited for takes a thread. Beyond these, gRPC itself refuses calls as RESOURCE_EXHAUSTED.
  grpc::ResourceQuota quota("calls");
  quota.SetMaxThreads(options.admitted_calls + options.spare_calls);
  builder.SetResourceQuota(quota);
  parts_->server = builder.BuildAndStart();
  if (!parts_->server || port == 0)
    throw UsageError(fmt::format(
        "--listen: nobody can listen at '{}'; is the port taken, or is that no address of this machine?",
        options.address));
  set_serving(true);
  address_ = fmt::format("{}:{}", options.address.substr(0, options.address.rfind(':')), port);
}

Server::~Server() {
  shut_down(std::chrono::system_clock::now());
}

void Server::set_serving(bool serving) {
  grpc::HealthCheckServiceInterface* health = parts_->server->GetHealthCheckService();
  health->SetServingStatus(serving);
  health->SetServingStatus(v1::SceneAnalyzer::service_full_name(), serving);
}

void Server::shut_down(std::chrono::system_clock::time_point deadline) {
  parts_->server->Shutdown(deadline);
  parts_->server->Wait();
}

}  // namespace scene_analyzer::rpc
