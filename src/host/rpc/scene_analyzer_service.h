// scene_analyzer_service.h — The calls of proto/scene_analyzer/v1/service.proto. One thread per call, from
// gRPC's pool.
#pragma once

#include <grpcpp/grpcpp.h>

#include "rpc/backend.h"
#include "rpc/peer_watch.h"
#include "scene_analyzer/v1/service.grpc.pb.h"

namespace scene_analyzer::rpc {

class SceneAnalyzerService final : public v1::SceneAnalyzer::Service {
 public:
  explicit SceneAnalyzerService(Backend& backend) : backend_(backend), watch_(backend.limits.silence) {}

  grpc::Status Analyze(grpc::ServerContext* context,
                       grpc::ServerReaderWriter<v1::AnalyzeResponse, v1::AnalyzeRequest>* stream) override;
  grpc::Status Render(grpc::ServerContext* context,
                      grpc::ServerReaderWriter<v1::RenderResponse, v1::RenderRequest>* stream) override;
  grpc::Status Rate(grpc::ServerContext* context, const v1::RateRequest* request,
                    v1::RateResponse* response) override;
  grpc::Status GetAnalysis(grpc::ServerContext* context, const v1::GetAnalysisRequest* request,
                           v1::GetAnalysisResponse* response) override;
  grpc::Status ListDevices(grpc::ServerContext* context, const v1::ListDevicesRequest* request,
                           v1::ListDevicesResponse* response) override;

 private:
  analysis::AssetAnalysis find_analysis(const std::string& content_key) const;

  Backend& backend_;
  PeerWatch watch_;
};

}  // namespace scene_analyzer::rpc
