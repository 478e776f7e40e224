// Analysis files, whole ones and payloads as they are under a right checksum: what is taken can be rated,
// printed and stored again.
#include "analysis_file/analysis_file.h"

#include "analysis_file/codec.h"
#include "analysis_file/envelope.h"
#include "analysis_file/sample.h"
#include "base/version.h"
#include "report/report.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  analysis::AssetAnalysis small = analysis_file::full_analysis();
  small.geometries.erase(small.geometries.begin() + 1, small.geometries.end());
  small.instances.erase(small.instances.begin(), small.instances.begin() + 1);
  small.instances.resize(1);
  small.timings.clear();
  small.computed.reset(analysis::index_of(analysis::Metric::kRenderingTime));
  std::vector<std::string> seeds;
  for (const analysis::AssetAnalysis& analysis : {analysis_file::full_analysis(), small}) {
    seeds.push_back(analysis_file::encode(analysis, version()));
    seeds.push_back(analysis_file::seal(seeds.back()));
  }
  return seeds;
}

namespace {

void check(analysis_file::Stored stored) {
  const std::string again = analysis_file::encode(stored.analysis, stored.version);
  require(std::holds_alternative<analysis_file::Stored>(analysis_file::decode(again)),
          "what was read can be stored and read");
  const std::vector<analysis::AssetAnalysis> assets(2, std::move(stored.analysis));
  for (const bool relative : {false, true}) {
    report::SceneReport report{
        .tool_version = "1", .device = {}, .parameters = {}, .options = {}, .assets = assets, .rating = {}};
    report.options.relative = relative;
    report.rating = ratings::rate(assets, report.options);
    report::json(report);
    report::csv(report);
    report::table(report, {});
  }
}

}  // namespace
}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  const std::string_view bytes = fuzz::text_of(data, size);
  const auto unsealed = analysis_file::unseal(bytes);
  const auto* payload = std::get_if<std::string_view>(&unsealed);
  auto decoded = analysis_file::decode(payload ? *payload : bytes);
  if (auto* stored = std::get_if<analysis_file::Stored>(&decoded))
    fuzz::check(std::move(*stored));
  else
    fuzz::require(!std::get<analysis_file::Unusable>(decoded).reason.empty(), "a refusal has a reason");
  return 0;
}
