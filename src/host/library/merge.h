// merge.h — The analyses of all shards of a library -> one scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "library/merged.h"
#include "report/report.h"

namespace scene_analyzer::library {

struct MergeOptions {
  ratings::Options ratings;  // metrics that were not analysed stay empty
  bool allow_missing = false;
};

// What a library lacks: one line per shard that has not finished, and one per asset whose analysis file is
// not what the journal says, the first of them and how many there are.
class Incomplete : public std::runtime_error {
 public:
  Incomplete(const std::string& what, std::vector<std::string> lines)
      : std::runtime_error(what), lines_(std::move(lines)) {}
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

// Called after each asset.
using MergeProgress = std::function<void(std::uint64_t done, std::uint64_t assets)>;

// Reads every analysis file of the library once, one at a time. Throws Incomplete unless that is allowed, and
// UsageError for a folder that holds no library. `warnings` gets what does not keep it from merging. Where
// assets were timed on several devices, each of them on one that all have in common counts. Memory: some 350
// bytes per mesh and 1.5 KiB per asset.
Merged merge(const std::filesystem::path& folder, const MergeOptions& options,
             std::vector<std::string>& warnings, const MergeProgress& progress = {});

// Of each rating, and last of the aggregate, the meshes with the largest values (of R_rd the largest
// magnitudes), `count` at most, with their names; of meshes of one shape and value the first stands for all.
// Ties in the order of the library. Reads the analysis files of those meshes, each once; calls `check` before
// each.
Offenders top_offenders(const std::filesystem::path& folder, const Merged& merged, std::size_t count,
                        const std::function<void()>& check = {});

// One line per mesh, with the columns of `analyze --csv` that a library has. Reads every analysis file again.
void write_csv(const std::filesystem::path& folder, const Merged& merged, const report::Sink& sink);
// The summary as JSON; docs/schema/library-v1.schema.json. `top`: duplicates listed.
std::string summary_json(const Merged& merged, const Offenders& offenders, std::size_t top);
// The summary for people.
std::string summary_table(const Merged& merged, const Offenders& offenders, std::size_t top,
                          const report::TableStyle& style);

}  // namespace scene_analyzer::library
