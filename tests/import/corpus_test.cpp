// Every asset of the shared collection, where it is present: a scene or one clear sentence, never a crash
// here; counts as its table of origins gives them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "import/temp_folder.h"

namespace scene_analyzer::import {
namespace {

namespace fs = std::filesystem;

fs::path collection() {
  if (const char* folder = std::getenv("SCENE_ANALYZER_ASSETS")) return folder;
  return fs::path(SCENE_ANALYZER_SOURCE_DIR) / "../shared/assets";
}

struct Row {
  std::string file;
  std::uint64_t faces = 0, meshes = 0;
  bool fine = false;  // Assimp's own raw import succeeds
};

std::vector<Row> table() {
  std::vector<Row> rows;
  std::ifstream stream(collection() / "LICENSES.md");
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> cells;
    std::istringstream split(line);
    for (std::string cell; std::getline(split, cell, '|');) {
      const std::size_t first = cell.find_first_not_of(' ');
      cells.push_back(
          first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    if (cells.size() < 12 || cells[7].empty() || !std::isdigit(static_cast<unsigned char>(cells[7][0])))
      continue;
    rows.push_back({cells[1], std::stoull(cells[7]), std::stoull(cells[8]), cells[10].ends_with("/ok")});
  }
  return rows;
}

TEST(ImportCorpus, CountsAreThoseOfTheTable) {
  if (!fs::exists(collection() / "LICENSES.md")) GTEST_SKIP() << "no collection at " << collection();
  std::size_t ran = 0, exact = 0;
  for (const Row& row : table()) {
    if (!row.fine || row.file.starts_with("bad/")) continue;
    SCOPED_TRACE(row.file);
    try {
      const mesh::Scene scene = import_asset(collection() / row.file);
      std::uint64_t triangles = 0, skipped = 0;
      for (const mesh::TriangleMesh& mesh : scene.meshes) {
        triangles += mesh.triangle_count();
        skipped += mesh.skipped_primitives;
      }
      EXPECT_EQ(scene.meshes.size(), row.meshes);
      EXPECT_GE(triangles + skipped, row.faces) << "a polygon is at least one triangle";
      EXPECT_FALSE(scene.format.empty());
      ++ran;
      exact += triangles + skipped == row.faces;
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
  }
  std::printf("%zu files of the table imported, %zu with exactly its number of faces\n", ran, exact);
  EXPECT_GT(ran, 200u);
}

bool is_model(const fs::path& file) {
  static const std::set<std::string> kOthers = {".bin", ".mtl", ".md", ".txt", ".png", ".jpg"};
  return !kOthers.contains(file.extension().string()) &&
         file.string().find("licence-texts") == std::string::npos;
}

TEST(ImportCorpus, EveryFileIsASceneOrOneSentence) {
  if (!fs::exists(collection())) GTEST_SKIP() << "no collection at " << collection();
  std::map<std::string, std::size_t> counts;
  std::vector<std::pair<double, std::string>> times;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(collection())) {
    if (!entry.is_regular_file() || !is_model(entry.path())) continue;
    const auto start = std::chrono::steady_clock::now();
    const std::string message = refusal(entry.path());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    times.emplace_back(seconds.count(), entry.path().filename().string());
    ++counts[message.empty()                                ? "scenes"
             : message.find("crashed") != std::string::npos ? "crashes of the worker"
                                                            : "refused"];
    if (message.empty()) continue;
    EXPECT_TRUE(message.starts_with(entry.path().string() + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), entry.path().string().size() + 400) << message;
  }
  std::sort(times.rbegin(), times.rend());
  std::printf("%zu files:", times.size());
  for (const auto& [what, count] : counts) std::printf(" %zu %s,", count, what.c_str());
  std::printf(" slowest");
  for (std::size_t i = 0; i < std::min<std::size_t>(times.size(), 5); ++i)
    std::printf(" %s %.2f s", times[i].second.c_str(), times[i].first);
  std::printf("\n");
  EXPECT_GT(counts["scenes"], 300u);
}

}  // namespace
}  // namespace scene_analyzer::import
