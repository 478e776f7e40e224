#include "service/metrics_server.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "base/error.h"

namespace scene_analyzer::service {
namespace {

std::string host_of(const std::string& address) {
  std::string host = address.substr(0, address.rfind(':'));
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  return host;
}

// Connects, and hangs up.
void knock(const std::string& host, int port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return;
  const int peer = ::socket(found->ai_family, found->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (peer >= 0) {
    ::connect(peer, found->ai_addr, found->ai_addrlen);
    ::close(peer);
  }
  ::freeaddrinfo(found);
}

}  // namespace

MetricsServer::MetricsServer(const std::string& address,
                             const std::vector<std::shared_ptr<prometheus::Collectable>>& collectables)
    : host_(host_of(address)) {
  try {
    exposer_ = std::make_unique<prometheus::Exposer>(address);
  } catch (const std::exception& error) {
    throw UsageError(fmt::format("--metrics-listen: nobody can listen at '{}': {}", address, error.what()));
  }
  for (const auto& collectable : collectables) exposer_->RegisterCollectable(collectable);
  port_ = exposer_->GetListeningPorts().front();
}

// CivetWeb looks every two seconds whether it is to end, and whenever somebody connects.
MetricsServer::~MetricsServer() {
  std::atomic<bool> ended = false;
  const std::jthread ending([&] {
    exposer_.reset();
    ended = true;
  });
  while (!ended) {
    knock(host_, port_);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace scene_analyzer::service
