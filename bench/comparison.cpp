#include "comparison.h"

#include <fmt/format.h>

#include <cmath>

namespace scene_analyzer::bench {
namespace {

using analysis::GeometryAnalysis;
using Count = std::optional<std::uint64_t>;
using Rating = std::optional<double>;

std::string text(const auto& value) {
  return value ? fmt::format("{}", *value) : std::string("nothing");
}

// Compares one mesh; keeps the first difference.
class Comparison {
 public:
  void count(const char* what, Count device, Count twin) {
    if (device != twin) differs(what, text(device), text(twin));
  }
  void rating(const char* what, Rating device, Rating twin) {
    // NaN is no agreement.
    const bool agree = device && twin ? std::abs(*device - *twin) <= 1e-5 : device == twin;
    if (!agree) differs(what, text(device), text(twin));
  }
  void area(double device, double twin) {
    if (!(std::abs(device - twin) <= 1e-6 * twin))
      differs("surface_area", fmt::format("{}", device), fmt::format("{}", twin));
  }
  const std::optional<std::string>& found() const { return found_; }

 private:
  void differs(const char* what, const std::string& device, const std::string& twin) {
    if (!found_) found_ = fmt::format("{} is {} on the device and {} in the twin", what, device, twin);
  }
  std::optional<std::string> found_;
};

std::optional<std::string> difference(const GeometryAnalysis& device, const GeometryAnalysis& twin,
                                      bool ratings) {
  if (!device.not_analysed.empty()) return device.not_analysed;
  Comparison compare;
  compare.count("triangles", device.triangles, twin.triangles);
  compare.count("degenerate_triangles", device.degenerate_triangles, twin.degenerate_triangles);
  compare.count("components", device.components, twin.components);
  compare.count("isolated_triangles", device.isolated_triangles, twin.isolated_triangles);
  compare.count("boundary_edges", device.boundary_edges, twin.boundary_edges);
  compare.count("non_manifold_edges", device.non_manifold_edges, twin.non_manifold_edges);
  compare.count("planar_groups", device.planar_groups, twin.planar_groups);
  compare.count("largest_planar_group", device.largest_planar_group, twin.largest_planar_group);
  compare.count("area_classes", device.area_classes, twin.area_classes);
  compare.area(device.surface_area, twin.surface_area);
  compare.rating("cooccurrence_contrast", device.cooccurrence_contrast, twin.cooccurrence_contrast);
  if (ratings) {
    compare.rating("polygons_per_planar_group", device.polygons_per_planar_group,
                   twin.polygons_per_planar_group);
    compare.rating("planar_group_variation", device.planar_group_variation, twin.planar_group_variation);
  }
  return compare.found();
}

}  // namespace

std::optional<std::string> first_difference(const std::vector<GeometryAnalysis>& device,
                                            const std::vector<GeometryAnalysis>& twin, bool ratings) {
  if (device.size() != twin.size())
    return fmt::format("{} meshes on the device and {} in the twin", device.size(), twin.size());
  for (std::size_t mesh = 0; mesh < device.size(); ++mesh)
    if (const auto found = difference(device[mesh], twin[mesh], ratings))
      return fmt::format("mesh {}: {}", mesh, *found);
  return std::nullopt;
}

}  // namespace scene_analyzer::bench
