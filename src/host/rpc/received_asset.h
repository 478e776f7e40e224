// received_asset.h — The first half of Analyze and Render: parameters, then files or a path.
#pragma once

#include <fmt/format.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "mesh/asset_source.h"
#include "rpc/call.h"
#include "rpc/peer_watch.h"
#include "service/refusal.h"
#include "service/uploads.h"

namespace scene_analyzer::rpc {

inline constexpr std::size_t kMostData = 4 << 20;  // bytes of a file in one message
inline constexpr std::size_t kLongestPath = 4096;  // bytes, below --root
inline constexpr double kLeastSpeed = 16 << 10;    // bytes per second of an upload, on average

struct ReceivedAsset {
  mesh::AssetSource asset;
  std::shared_ptr<const void> files;  // what was uploaded, removed with the last owner
};

// Reads what the client sends until it has sent all. `Request` is a message with `oneof part` of parameters,
// file and data. Throws service::Refusal for what is out of order, beyond a limit or not there.
template <typename Request, typename Response>
class AssetReceiver {
 public:
  using Stream = grpc::ServerReaderWriter<Response, Request>;
  using Parameters = std::decay_t<decltype(std::declval<Request>().parameters())>;

  AssetReceiver(Call& call, Stream& stream, PeerWatch& watch, Backend& backend)
      : call_(call), stream_(stream), watch_(watch), backend_(backend) {}

  // `take` is given the parameters before any file is read, and throws service::Refusal for what is wrong
  // with them.
  ReceivedAsset receive(const std::function<void(const Parameters&)>& take) {
    using service::Reason;
    using service::Refusal;
    Request request;
    const bool is_there = read(request);
    call_.check_cancelled();
    if (!is_there)
      throw Refusal(Reason::kInvalid,
                    "the first message must hold the parameters; none came, or none that can be parsed");
    if (request.part_case() != Request::kParameters)
      throw Refusal(Reason::kInvalid, "the first message must hold the parameters; this one holds others");
    take(request.parameters());
    if (!request.parameters().path().empty()) return at_path(request.parameters().path());
    const auto upload = std::make_shared<service::Upload>(backend_.uploads, backend_.limits.upload_bytes);
    while (read(request)) {
      add(request, *upload);
      check_speed();
    }
    call_.check_cancelled();  // the end of a broken connection is no end of files
    // gRPC also says so of a message that it cannot parse. Where that was the last, nothing tells it from the
    // end, but the size that was announced.
    if (read(request)) throw Refusal(Reason::kInvalid, kCannotBeParsed);
    mesh::AssetSource asset = upload->finish();
    call_.record().asset = asset.name;
    return {std::move(asset), upload};
  }

 private:
  bool read(Request& request) {
    const PeerWatch::Wait wait(watch_, call_.context());
    if (!stream_.Read(&request)) return false;
    check_size(request.ByteSizeLong());
    return true;
  }

  // A place is not held by a trickle.
  void check_speed() const {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    const std::chrono::duration<double> sending(static_cast<double>(call_.record().upload_bytes) /
                                                kLeastSpeed);
    if (taken > watch_.patience() + sending)
      throw service::Refusal(
          service::Reason::kCancelled,
          fmt::format(
              "the upload is slower than {} bytes per second for longer than {} s; send it over a faster "
              "line, or have the service's --silence raised",
              kLeastSpeed, watch_.patience().count()));
  }

  void add(const Request& request, service::Upload& upload) {
    using service::Reason;
    using service::Refusal;
    switch (request.part_case()) {
      case Request::kFile:
        upload.begin_file(request.file().name(),
                          request.file().has_size() ? std::optional(request.file().size()) : std::nullopt);
        return;
      case Request::kData:
        if (request.data().empty()) throw Refusal(Reason::kInvalid, "a message holds no data");
        if (request.data().size() > kMostData)
          throw Refusal(Reason::kInvalid,
                        "a message holds more than 4 MiB of data; send files in smaller pieces");
        upload.add(request.data());
        call_.record().upload_bytes += request.data().size();
        return;
      case Request::kParameters:
        throw Refusal(Reason::kInvalid, "parameters came twice; they are the first message");
      default:
        throw Refusal(Reason::kInvalid, "a message holds neither a file's header nor data");
    }
  }

  ReceivedAsset at_path(const std::string& path) {
    using service::Reason;
    using service::Refusal;
    if (backend_.root == nullptr)
      throw Refusal(Reason::kInvalid, "path: this service has no --root; send the files instead");
    if (path.size() > kLongestPath)
      throw Refusal(Reason::kInvalid, fmt::format("path: has more than {} bytes", kLongestPath));
    call_.record().asset = path;
    if (Request request; read(request))
      throw Refusal(Reason::kInvalid, "path: an asset below --root is named, and files are sent as well");
    call_.check_cancelled();
    return {backend_.root->find(path), nullptr};
  }

  Call& call_;
  Stream& stream_;
  PeerWatch& watch_;
  Backend& backend_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace scene_analyzer::rpc
