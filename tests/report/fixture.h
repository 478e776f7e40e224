// fixture.h — Scenes for the report's tests, and a folder that goes away with its test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/report.h"

namespace scene_analyzer::report {

// A report and what its spans point to.
struct Fixture {
  std::vector<analysis::AssetAnalysis> assets;
  ratings::Options options;

  SceneReport report() const;  // rated anew at every call
};

// Two assets: a leg instanced twice with every figure, an empty mesh; a mesh that was not analysed, one with
// a hostile name.
Fixture two_assets();
// One asset of `count` instances of one geometry.
Fixture many_instances(std::size_t count);

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::filesystem::path path;
};

std::string contents_of(const std::filesystem::path& file);

}  // namespace scene_analyzer::report
