#include "report/glb.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "report/glb_arrays.h"
#include "report/glb_document.h"
#include "report/glb_layout.h"

namespace scene_analyzer::report {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeadBytes = 12, kChunkHeadBytes = 8;
constexpr std::size_t kTotalAt = 8, kJsonLengthAt = 12;

void check_arguments(const SceneReport& report, std::span<const mesh::Scene* const> scenes,
                     std::span<const std::optional<ratings::Rgb>> colors) {
  if (scenes.size() != report.assets.size() || colors.size() != report.rating.meshes.size())
    throw std::invalid_argument("glb: as many scenes as assets and as many colours as meshes are needed");
  for (const ratings::MeshRating& row : report.rating.meshes) {
    const analysis::AssetAnalysis& asset = report.assets[row.asset];
    const mesh::Scene& scene = *scenes[row.asset];
    const std::uint32_t geometry = asset.instances.at(row.instance).geometry;
    if (scene.instances.size() != asset.instances.size() ||
        scene.meshes[scene.instances[row.instance].mesh].triangle_count() !=
            asset.geometries.at(geometry).source_triangles)
      throw InputError(asset.asset + ": the file changed while it was worked on; run the command again");
  }
}

void check_size(std::uint64_t bytes) {
  if (bytes <= std::numeric_limits<std::uint32_t>::max()) return;
  const double gibibytes = static_cast<double>(bytes) / (1 << 30);
  throw InputError(
      fmt::format("the exported scene takes {:.1f} GiB, but a GLB file holds less than 4 GiB; export fewer "
                  "assets at once, or use --json, which has the ratings without the geometry",
                  std::ceil(gibibytes * 10) / 10));
}

void put_word(std::string& out, std::size_t at, std::uint32_t value) {
  std::string word;
  append_word(word, value);
  out.replace(at, word.size(), word);
}

}  // namespace

std::string glb(const SceneReport& report, std::span<const mesh::Scene* const> scenes,
                std::span<const std::optional<ratings::Rgb>> colors) {
  check_arguments(report, scenes, colors);
  const GlbLayout layout = plan_glb(report.rating.meshes, scenes, colors);
  check_size(layout.bytes);
  std::string out;
  for (const std::uint32_t word : {kMagic, kVersion, 0u, 0u, kJsonChunk}) append_word(out, word);
  append_document(out, report, scenes, layout);
  out.append((4 - out.size() % 4) % 4, ' ');
  const std::uint64_t total = out.size() + (layout.bytes == 0 ? 0 : kChunkHeadBytes + layout.bytes);
  check_size(total);
  put_word(out, kTotalAt, static_cast<std::uint32_t>(total));
  put_word(out, kJsonLengthAt, static_cast<std::uint32_t>(out.size() - kHeadBytes - kChunkHeadBytes));
  if (layout.bytes == 0) return out;
  out.reserve(total);
  append_word(out, static_cast<std::uint32_t>(layout.bytes));
  append_word(out, kBinaryChunk);
  append_arrays(out, layout);
  return out;
}

}  // namespace scene_analyzer::report
