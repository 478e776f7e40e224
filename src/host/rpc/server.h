// server.h — The service on the network: where it listens, who may connect, whether it is healthy.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "rpc/backend.h"

namespace scene_analyzer::rpc {

struct Tls {
  std::filesystem::path certificate, key;  // PEM: the chain, its own certificate first, and the private key
  std::optional<std::filesystem::path>
      client_ca;  // PEM: clients need certificates that one of these has signed
};

struct ServerOptions {
  std::string address = "127.0.0.1:50051";  // port 0: any free one
  std::optional<Tls> tls;                   // without it nothing is encrypted
  // Calls at the same time, besides those that Backend::admission has admitted.
  int spare_calls = 64;
  int admitted_calls = 64;
};

// Whether nobody but this machine's programs can reach `address`. Names other than localhost are looked up by
// nobody: they count as reachable.
bool is_loopback(const std::string& address);

// With grpc.health.v1 for "" and "scene_analyzer.v1.SceneAnalyzer", and server reflection.
class Server {
 public:
  // Listens and serves from now on. Throws UsageError when the address cannot be had or the
  // certificates cannot be used. `backend` must outlive it.
  Server(const ServerOptions& options, Backend& backend);
  // As shut_down() with no time left.
  ~Server();

  const std::string& address() const { return address_; }  // with the port that was given
  void set_serving(bool serving);
  // Takes no more calls, and cancels those that have not ended at `deadline`; returns when all have ended.
  void shut_down(std::chrono::system_clock::time_point deadline);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  std::string address_;
};

}  // namespace scene_analyzer::rpc
