// output_folder.h — The folder that a library's analyses are kept in, which several tasks may share.
//
//   library.jsonl                             what it consists of, and under which options it is analysed
//   analyses/<path of the asset>.analysis     an analysis file per asset
//   journal/shard-00000-of-00001.jsonl        what became of each asset of a shard, in the library's order
//   journal/shard-...<process>.running.jsonl  the same of a run that goes on, or was killed, in its order
//
// Every file is replaced in one step or belongs to one run alone, so that tasks on several machines, or the
// same task started twice, do not disturb each other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "analysis/metric.h"
#include "library/asset_list.h"

namespace scene_analyzer::library {

// library.jsonl: a line about all, then one per asset.
struct Manifest {
  std::string tool_version;
  analysis::Parameters parameters;
  analysis::MetricSet metrics;
  std::uint32_t timing_width = 512, timing_height = 512;  // pixels
  std::uint32_t shard_count = 1;
  std::vector<ListedAsset> assets;    // ascending by path
  std::vector<std::uint32_t> shards;  // of each asset
  bool operator==(const Manifest&) const = default;
};

std::filesystem::path analyses_folder(const std::filesystem::path& folder);
std::filesystem::path journal_folder(const std::filesystem::path& folder);

// Creates the folder and what it needs. Throws UsageError when it cannot be made or written.
void prepare_folder(const std::filesystem::path& folder);

// Replaces library.jsonl, unless it says just this. Throws UsageError when it cannot be written.
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);
// Throws UsageError where there is none, or none that can be understood.
Manifest read_manifest(const std::filesystem::path& folder);

}  // namespace scene_analyzer::library
