// scene_analyzer_service.h — The calls of proto/scene_analyzer/v1/service.proto. One thread per call, from
// gRPC's pool.
#pragma once

#include <grpcpp/grpcpp.h>

#include <string>
#include <vector>

#include "rpc/backend.h"
#include "rpc/call.h"
#include "rpc/peer_watch.h"
#include "scene_analyzer/v1/service.grpc.pb.h"

namespace scene_analyzer::rpc {

// Calls of one message are read and written as streams of one, which is the same on the network: nothing of
// a request is read before its token is known, and a client that does not read its answer can be cut off.
using CallsAsStreams =
    v1::SceneAnalyzer::WithStreamedUnaryMethod_Rate<v1::SceneAnalyzer::WithStreamedUnaryMethod_GetAnalysis<
        v1::SceneAnalyzer::WithStreamedUnaryMethod_ListDevices<v1::SceneAnalyzer::Service>>>;

class SceneAnalyzerService final : public CallsAsStreams {
 public:
  explicit SceneAnalyzerService(Backend& backend) : backend_(backend), watch_(backend.limits.silence) {}

  grpc::Status Analyze(grpc::ServerContext* context,
                       grpc::ServerReaderWriter<v1::AnalyzeResponse, v1::AnalyzeRequest>* stream) override;
  grpc::Status Render(grpc::ServerContext* context,
                      grpc::ServerReaderWriter<v1::RenderResponse, v1::RenderRequest>* stream) override;
  grpc::Status StreamedRate(grpc::ServerContext* context,
                            grpc::ServerUnaryStreamer<v1::RateRequest, v1::RateResponse>* stream) override;
  grpc::Status StreamedGetAnalysis(
      grpc::ServerContext* context,
      grpc::ServerUnaryStreamer<v1::GetAnalysisRequest, v1::GetAnalysisResponse>* stream) override;
  grpc::Status StreamedListDevices(
      grpc::ServerContext* context,
      grpc::ServerUnaryStreamer<v1::ListDevicesRequest, v1::ListDevicesResponse>* stream) override;

 private:
  std::vector<analysis::AssetAnalysis> find_analyses(const Call& call, const v1::RateRequest& request) const;
  analysis::AssetAnalysis find_analysis(const std::string& content_key) const;

  Backend& backend_;
  PeerWatch watch_;
};

}  // namespace scene_analyzer::rpc
