#include "rpc/scene_analyzer_service.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "ratings/ratings.h"
#include "rpc/call.h"
#include "rpc/followed_job.h"
#include "rpc/messages.h"
#include "rpc/parameters.h"
#include "rpc/received_asset.h"

namespace scene_analyzer::rpc {
namespace {

using service::Reason;
using service::Refusal;

constexpr std::size_t kMostInstances = 1'000'000;  // that are rated together: some 500 MB

template <typename Stream, typename Response>
void write(Call& call, Stream& stream, PeerWatch& watch, const Response& response) {
  const PeerWatch::Wait wait(watch, call.context(), response.ByteSizeLong());
  if (!stream.Write(response)) throw Refusal(Reason::kCancelled, "the client no longer reads the answer");
}

// Of a call that has one message.
template <typename Request, typename Response>
Request read(Call& call, grpc::ServerUnaryStreamer<Request, Response>& stream, PeerWatch& watch) {
  Request request;
  const PeerWatch::Wait wait(watch, call.context());
  if (stream.Read(&request)) {
    check_size(request.ByteSizeLong());
    return request;
  }
  call.check_cancelled();
  throw Refusal(Reason::kInvalid, kCannotBeParsed);
}

}  // namespace

grpc::Status SceneAnalyzerService::Analyze(
    grpc::ServerContext* context, grpc::ServerReaderWriter<v1::AnalyzeResponse, v1::AnalyzeRequest>* stream) {
  Call call(backend_, "Analyze", *context);
  return call.run([&] {
    const service::Admission::Ticket ticket = backend_.admission.admit();
    pipeline::Options options;
    ReceivedAsset received =
        AssetReceiver(call, *stream, watch_, backend_).receive([&](const v1::AnalyzeParameters& parameters) {
          options = read_measuring(parameters.measuring(), quick_metrics(), backend_);
        });
    service::Order order{std::move(received.asset), std::move(received.files), std::move(options), {}};
    v1::AnalyzeResponse response;
    service::Answer answer =
        follow_job(call, backend_.executor, std::move(order), [&](const v1::Progress& progress) {
          *response.mutable_progress() = progress;
          write(call, *stream, watch_, response);
        });
    v1::AnalyzeResult& result = *response.mutable_result();
    *result.mutable_analysis() = to_message(*answer.analysis);
    result.set_from_store(call.record().from_store = answer.from_store);
    for (std::string& message : answer.messages) result.add_messages(std::move(message));
    write(call, *stream, watch_, response);
  });
}

grpc::Status SceneAnalyzerService::Render(
    grpc::ServerContext* context, grpc::ServerReaderWriter<v1::RenderResponse, v1::RenderRequest>* stream) {
  Call call(backend_, "Render", *context);
  return call.run([&] {
    const service::Admission::Ticket ticket = backend_.admission.admit();
    service::PictureOrder picture;
    pipeline::Options options;
    ReceivedAsset received =
        AssetReceiver(call, *stream, watch_, backend_).receive([&](const v1::RenderParameters& parameters) {
          picture = read_picture(parameters);
          options = read_measuring(parameters.measuring(), metrics_of(picture), backend_);
        });
    service::Order order{std::move(received.asset), std::move(received.files), std::move(options), picture};
    v1::RenderResponse response;
    service::Answer answer =
        follow_job(call, backend_.executor, std::move(order), [&](const v1::Progress& progress) {
          *response.mutable_progress() = progress;
          write(call, *stream, watch_, response);
        });
    call.record().from_store = answer.from_store;
    v1::Picture& drawn = *response.mutable_picture();
    drawn.set_png(std::move(answer.png));
    drawn.set_content_key(analysis_file::content_key(*answer.analysis));
    for (std::string& message : answer.messages) drawn.add_messages(std::move(message));
    write(call, *stream, watch_, response);
  });
}

grpc::Status SceneAnalyzerService::StreamedRate(
    grpc::ServerContext* context, grpc::ServerUnaryStreamer<v1::RateRequest, v1::RateResponse>* stream) {
  Call call(backend_, "Rate", *context);
  return call.run([&] {
    const service::Admission::Ticket ticket = backend_.admission.admit();
    const v1::RateRequest request = read(call, *stream, watch_);
    const ratings::Options options = read_rating(request.rating());
    write(call, *stream, watch_, to_message(ratings::rate(find_analyses(call, request), options)));
  });
}

std::vector<analysis::AssetAnalysis> SceneAnalyzerService::find_analyses(
    const Call& call, const v1::RateRequest& request) const {
  if (request.assets().empty()) throw Refusal(Reason::kInvalid, "assets: there is none; name at least one");
  std::vector<analysis::AssetAnalysis> analyses;
  std::size_t instances = 0;
  for (const v1::AnalysisReference& asset : request.assets()) {
    call.check_cancelled();
    const std::string where = fmt::format("assets[{}]", analyses.size());
    if (asset.has_analysis())
      analyses.push_back(from_message(asset.analysis(), where));
    else if (!asset.content_key().empty())
      analyses.push_back(find_analysis(asset.content_key()));
    else
      throw Refusal(Reason::kInvalid, where + ": holds neither a content key nor an analysis");
    instances += analyses.back().instances.size() + 1;
    if (instances > kMostInstances)
      throw Refusal(Reason::kTooLarge,
                    fmt::format("the scene has more than {} meshes; rate parts of it", kMostInstances));
  }
  return analyses;
}

analysis::AssetAnalysis SceneAnalyzerService::find_analysis(const std::string& content_key) const {
  if (!backend_.store) throw Refusal(Reason::kNotFound, "this service keeps no analyses (--store)");
  if (auto analysis = backend_.store->get(content_key)) return std::move(*analysis);
  throw Refusal(Reason::kNotFound,
                fmt::format("no analysis has the content key '{}' (any more)", content_key));
}

grpc::Status SceneAnalyzerService::StreamedGetAnalysis(
    grpc::ServerContext* context,
    grpc::ServerUnaryStreamer<v1::GetAnalysisRequest, v1::GetAnalysisResponse>* stream) {
  Call call(backend_, "GetAnalysis", *context);
  return call.run([&] {
    const service::Admission::Ticket ticket = backend_.admission.admit();
    v1::GetAnalysisResponse response;
    const v1::GetAnalysisRequest request = read(call, *stream, watch_);
    *response.mutable_analysis() = to_message(find_analysis(request.content_key()));
    write(call, *stream, watch_, response);
  });
}

grpc::Status SceneAnalyzerService::StreamedListDevices(
    grpc::ServerContext* context,
    grpc::ServerUnaryStreamer<v1::ListDevicesRequest, v1::ListDevicesResponse>* stream) {
  Call call(backend_, "ListDevices", *context);
  return call.run([&] {
    read(call, *stream, watch_);
    const analysis::DeviceStamp used = backend_.executor.device();
    v1::ListDevicesResponse response;
    for (const gpu::DeviceInfo& device : backend_.devices)
      *response.add_devices() = to_message(device, device.id == used.id && device.name == used.name);
    write(call, *stream, watch_, response);
  });
}

}  // namespace scene_analyzer::rpc
