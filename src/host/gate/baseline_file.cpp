#include "gate/baseline_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "base/error.h"
#include "base/version.h"
#include "files/file.h"
#include "report/document.h"
#include "report/report.h"
#include "report/terminal_text.h"

namespace scene_analyzer::gate {
namespace {

namespace fs = std::filesystem;
using analysis::RenderTiming;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

ordered_json values_of(const Values& values) {
  ordered_json object = ordered_json::object();
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (!values[i] || !std::isfinite(*values[i])) continue;
    const QuantityInfo& about = info(static_cast<Quantity>(i));
    if (about.whole)
      object[std::string(about.key)] = static_cast<std::uint64_t>(*values[i]);
    else
      object[std::string(about.key)] = *values[i] + 0.0;
  }
  return object;
}

Values values_from(const json& object) {
  Values values;
  for (const auto& [key, value] : object.items())
    // Quantities of a later program are not this one's concern.
    if (const auto quantity = quantity_of(key)) values[index_of(*quantity)] = value.get<double>();
  return values;
}

ordered_json timing_of(const std::optional<RenderTiming::Conditions>& timing) {
  if (!timing) return nullptr;
  return {{"device", timing->device.name},      {"driver", timing->device.driver},
          {"device_type", timing->device.type}, {"width", timing->width},
          {"height", timing->height},           {"steps", timing->steps}};
}

std::optional<RenderTiming::Conditions> timing_from(const json& object) {
  if (object.is_null()) return std::nullopt;
  RenderTiming::Conditions timing;
  timing.device.name = object.at("device").get<std::string>();
  timing.device.driver = object.at("driver").get<std::string>();
  timing.device.type = object.at("device_type").get<std::string>();
  timing.width = object.at("width").get<std::uint32_t>();
  timing.height = object.at("height").get<std::uint32_t>();
  timing.steps = object.at("steps").get<std::uint32_t>();
  return timing;
}

ordered_json parameters_of(const analysis::Parameters& parameters) {
  return {{"alpha", parameters.alpha_degrees},
          {"dim", parameters.dim},
          {"weld_tolerance", parameters.weld_tolerance},
          {"start_searches", parameters.start_searches}};
}

analysis::Parameters parameters_from(const json& object) {
  analysis::Parameters parameters;
  parameters.alpha_degrees = object.at("alpha").get<double>();
  parameters.dim = object.at("dim").get<std::uint32_t>();
  parameters.weld_tolerance = object.at("weld_tolerance").get<double>();
  parameters.start_searches = object.at("start_searches").get<std::uint64_t>();
  return parameters;
}

ordered_json document_of(const AssetBaseline& baseline) {
  ordered_json weights = ordered_json::object(), meshes = ordered_json::array();
  for (std::size_t i = 0; i < baseline.weights.size(); ++i)
    weights[std::string(analysis::kMetricKeys[i])] = baseline.weights[i];
  for (const BaselineMesh& mesh : baseline.meshes)
    meshes.push_back({{"node", mesh.node}, {"mesh", mesh.mesh}, {"values", values_of(mesh.values)}});
  return {{"scene_analyzer_baseline", 1},
          {"asset", report::valid_utf8(baseline.asset)},
          {"tool", {{"version", version()}}},
          {"parameters", parameters_of(baseline.parameters)},
          {"weights", std::move(weights)},
          {"eye", baseline.eye ? ordered_json(*baseline.eye) : ordered_json()},
          {"render_timing", timing_of(baseline.timing)},
          {"values", values_of(baseline.values)},
          {"meshes", std::move(meshes)}};
}

AssetBaseline baseline_from(const json& document) {
  if (document.at("scene_analyzer_baseline").get<int>() != 1)
    throw std::invalid_argument("it is of another version of the program");
  AssetBaseline baseline;
  baseline.asset = document.at("asset").get<std::string>();
  baseline.tool_version = document.at("tool").at("version").get<std::string>();
  baseline.parameters = parameters_from(document.at("parameters"));
  for (std::size_t i = 0; i < baseline.weights.size(); ++i)
    baseline.weights[i] = document.at("weights").at(std::string(analysis::kMetricKeys[i])).get<double>();
  if (!document.at("eye").is_null()) baseline.eye = document.at("eye").get<mesh::Vector3>();
  baseline.timing = timing_from(document.at("render_timing"));
  baseline.values = values_from(document.at("values"));
  for (const json& mesh : document.at("meshes"))
    baseline.meshes.push_back({mesh.at("node").get<std::string>(), mesh.at("mesh").get<std::string>(),
                               values_from(mesh.at("values"))});
  return baseline;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw UsageError(
      fmt::format("--baseline: {}: {}; write it anew with --write-baseline", file.string(), reason));
}

std::optional<std::string> text_of(const fs::path& place) {
  try {
    files::File file = files::File::open_regular(place);
    const std::uint64_t size = file.size();
    if (size > kMostBytes) refuse(place, "it is too large to be a baseline");
    std::string text(size, '\0');
    text.resize(file.read(text));
    return text;
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory || error.code() == std::errc::not_a_directory)
      return std::nullopt;
    refuse(place, fmt::format("it cannot be read: {}", error.code().message()));
  }
}

}  // namespace

void write_baseline(const fs::path& folder, const AssetBaseline& baseline) {
  const fs::path place = baseline_place(folder, baseline.asset);
  std::error_code error;
  fs::create_directories(place.parent_path(), error);
  if (error)
    throw InputError(fmt::format("cannot create {}: {}", place.parent_path().string(), error.message()));
  report::write_file(place, report::print(document_of(baseline), 1) + '\n');
}

std::optional<AssetBaseline> read_baseline(const fs::path& folder, const std::string& asset) {
  const fs::path place = baseline_place(folder, asset);
  const std::optional<std::string> text = text_of(place);
  if (!text) return std::nullopt;
  try {
    AssetBaseline baseline = baseline_from(json::parse(*text));
    if (baseline.asset != report::valid_utf8(asset))
      refuse(place, fmt::format("it is the baseline of {}", baseline.asset));
    return baseline;
  } catch (const json::exception& error) {
    refuse(place, fmt::format("it is no baseline ({})", error.what()));
  } catch (const std::invalid_argument& error) {
    refuse(place, error.what());
  }
}

void require_comparable(const AssetBaseline& before, const AssetBaseline& now) {
  const auto differ = [&](const std::string& what) {
    throw UsageError(
        fmt::format("--baseline: that of {} was written with {}; use the same, or write it anew with "
                    "--write-baseline",
                    before.asset, what));
  };
  const auto &a = before.parameters, &b = now.parameters;
  if (a.alpha_degrees != b.alpha_degrees) differ(fmt::format("--alpha {}", a.alpha_degrees));
  if (a.dim != b.dim) differ(fmt::format("--dim {}", a.dim));
  if (a.weld_tolerance != b.weld_tolerance) differ(fmt::format("--weld-tolerance {}", a.weld_tolerance));
  if (a.start_searches != b.start_searches) differ(fmt::format("--start-searches {}", a.start_searches));
  if (before.weights != now.weights) differ("other weights in the budget");
  if (before.eye != now.eye) differ("another eye in the budget");
}

}  // namespace scene_analyzer::gate
