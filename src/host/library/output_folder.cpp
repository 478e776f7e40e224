#include "library/output_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "base/version.h"
#include "files/file.h"
#include "files/replace.h"
#include "library/json_text.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kFormat = 1;

fs::path manifest_file(const fs::path& folder) {
  return folder / "library.jsonl";
}

std::string header_line(const Manifest& manifest) {
  ordered_json line;
  line["library_format"] = kFormat;
  line["tool_version"] = manifest.tool_version;
  line["alpha_degrees"] = manifest.parameters.alpha_degrees;
  line["dim"] = manifest.parameters.dim;
  line["weld_tolerance"] = manifest.parameters.weld_tolerance;
  line["steps"] = manifest.parameters.steps;
  line["timing_width"] = manifest.timing_width;
  line["timing_height"] = manifest.timing_height;
  line["start_searches"] = manifest.parameters.start_searches;
  line["metrics"] = keys_of(manifest.metrics);
  line["shard_count"] = manifest.shard_count;
  line["assets"] = manifest.assets.size();
  return one_line_of(line) + '\n';
}

Manifest read_header(const json& line) {
  if (line.at("library_format") != kFormat) throw std::invalid_argument("another format");
  Manifest manifest;
  manifest.tool_version = line.at("tool_version").get<std::string>();
  manifest.parameters.alpha_degrees = line.at("alpha_degrees").get<double>();
  manifest.parameters.dim = line.at("dim").get<std::uint32_t>();
  manifest.parameters.weld_tolerance = line.at("weld_tolerance").get<double>();
  manifest.parameters.steps = line.at("steps").get<std::uint32_t>();
  manifest.parameters.start_searches = line.at("start_searches").get<std::uint64_t>();
  manifest.timing_width = line.at("timing_width").get<std::uint32_t>();
  manifest.timing_height = line.at("timing_height").get<std::uint32_t>();
  manifest.metrics = metrics_of(line.at("metrics"));
  manifest.shard_count = line.at("shard_count").get<std::uint32_t>();
  return manifest;
}

std::string text_of(const Manifest& manifest) {
  std::string text = header_line(manifest);
  for (std::size_t i = 0; i < manifest.assets.size(); ++i) {
    ordered_json line;
    put_bytes(line, "asset", manifest.assets[i].path);
    line["bytes"] = manifest.assets[i].bytes;
    line["shard"] = manifest.shards[i];
    text += one_line_of(line) + '\n';
  }
  return text;
}

Manifest parse(std::istream& lines) {
  std::string line;
  if (!std::getline(lines, line)) throw std::invalid_argument("nothing in it");
  const json header = json::parse(line);
  Manifest manifest = read_header(header);
  while (std::getline(lines, line)) {
    const json asset = json::parse(line);
    manifest.assets.push_back({get_bytes(asset, "asset"), asset.at("bytes").get<std::uint64_t>()});
    manifest.shards.push_back(asset.at("shard").get<std::uint32_t>());
  }
  if (header.at("assets") != manifest.assets.size()) throw std::invalid_argument("assets are missing in it");
  return manifest;
}

[[noreturn]] void refuse(const fs::path& folder, const std::error_code& code) {
  throw UsageError(fmt::format("--out: '{}' cannot be written: {}", folder.string(), files::describe(code)));
}

}  // namespace

fs::path analyses_folder(const fs::path& folder) {
  return folder / "analyses";
}

fs::path journal_folder(const fs::path& folder) {
  return folder / "journal";
}

void prepare_folder(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& part : {analyses_folder(folder), journal_folder(folder)}) {
    fs::create_directories(part, error);
    if (error) refuse(part, error);
  }
}

void write_manifest(const fs::path& folder, const Manifest& manifest) {
  const fs::path path = manifest_file(folder);
  const std::string text = text_of(manifest);
  if (std::ifstream file(path, std::ios::binary);
      file && std::string(std::istreambuf_iterator<char>(file), {}) == text)
    return;
  try {
    files::replace(path, text);
  } catch (const std::system_error& error) {
    refuse(path, error.code());
  }
}

Manifest read_manifest(const fs::path& folder) {
  const fs::path path = manifest_file(folder);
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw UsageError(fmt::format("{}: cannot be read; is '{}' the folder that batch --out was given?",
                                 path.string(), folder.string()));
  const auto damaged = [&](const char* reason) {
    return UsageError(fmt::format("{}: cannot be understood ({}); run batch again", path.string(), reason));
  };
  try {
    return parse(file);
  } catch (const json::exception& error) {
    throw damaged(error.what());
  } catch (const std::invalid_argument& error) {
    throw damaged(error.what());
  }
}

}  // namespace scene_analyzer::library
