// marks.h — Rings around meshes that are too small to be seen by their colour.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "pictures/picture_content.h"
#include "scene_render/camera.h"

namespace scene_analyzer::pictures {

// A ring in a view, in pixels from its upper left corner.
struct Mark {
  double x = 0, y = 0;
  std::string name;  // of the mesh; empty where many marks would hide each other's
};

// Of the extreme meshes that look smaller than a ring of `least_radius` pixels, those within the view; none
// without Content::emphasize_extremes. At most 100, those of the highest values.
std::vector<Mark> mark_small_extremes(const Content& content, const ratings::SceneRating& rating,
                                      std::span<const analysis::AssetAnalysis> assets,
                                      const scene_render::Camera& camera, std::uint32_t width,
                                      std::uint32_t height, double least_radius);

}  // namespace scene_analyzer::pictures
