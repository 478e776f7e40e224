// Every asset of the shared collection that imports, measured on the device and by the plain twin.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "import/import.h"
#include "pipeline/compare.h"
#include "pipeline/measure.h"
#include "support/gpu_test.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;

// The twin takes its time for meshes beyond this under sanitizers; they run in the optimised suite.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t kMostTriangles = 20'000;
#else
constexpr std::uint64_t kMostTriangles = 2'000'000;
#endif

fs::path collection() {
  if (const char* folder = std::getenv("SCENE_ANALYZER_ASSETS")) return folder;
  return fs::path(SCENE_ANALYZER_SOURCE_DIR) / "../shared/assets";
}

class MeasureCorpus : public test::GpuTest {
 protected:
  void run(const char* folder, std::size_t at_least) {
    if (!fs::exists(collection() / folder)) GTEST_SKIP() << "no collection at " << collection();
    Measurer measurer(device());
    std::size_t measured = 0, refused = 0, large = 0, meshes = 0, all_pairs = 0;
    std::uint64_t triangles = 0;
    for (const auto& entry : fs::recursive_directory_iterator(collection() / folder)) {
      if (!entry.is_regular_file()) continue;
      try {
        const mesh::Scene scene = import::import_asset(entry.path());
        std::uint64_t size = 0;
        for (const mesh::TriangleMesh& mesh : scene.meshes) size += mesh.triangle_count();
        if (size > kMostTriangles) {
          ++large;
          continue;
        }
        analysis::AssetAnalysis analysis;
        measurer.measure({.scene = scene, .analysis = analysis});
        all_pairs += expect_agrees_with_twin(scene, {}, analysis);
        ++measured;
        meshes += analysis.instances.size();
        triangles += size;
      } catch (const InputError&) {
        ++refused;  // textures, buffers and broken files; the import room's tests look at those
      }
    }
    std::printf(
        "%s: %zu assets with %zu mesh instances and %llu triangles agree with the twin; "
        "%zu meshes' start triangles are those of all pairs; %zu assets left out as too large here, %zu "
        "files "
        "refused\n",
        folder, measured, meshes, static_cast<unsigned long long>(triangles), all_pairs, large, refused);
    EXPECT_GE(measured + large, at_least);
  }
};

TEST_F(MeasureCorpus, Models) {
  run("models", 30);
}
TEST_F(MeasureCorpus, Formats) {
  run("formats", 50);
}
TEST_F(MeasureCorpus, Scenes) {
  run("scenes", 10);
}
TEST_F(MeasureCorpus, Features) {
  run("features", 40);
}
TEST_F(MeasureCorpus, Library) {
  run("library", 50);
}
TEST_F(MeasureCorpus, Bad) {
  run("bad", 60);
}

}  // namespace
}  // namespace scene_analyzer::pipeline
