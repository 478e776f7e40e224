// picture_content.h — What one picture of a rated scene shows, and how every mesh looks in it. No GPU, no
// files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/metric.h"
#include "ratings/ratings.h"
#include "scene_render/look.h"

namespace scene_analyzer::pictures {

enum class Subject { kMetric, kAggregate, kPlanarGroups, kOwnColors };

struct Content {
  Subject subject = Subject::kAggregate;
  analysis::Metric metric = analysis::Metric::kPolygonsPerPlanarGroup;  // of kMetric
  bool relative = false;
  ratings::ColorMap map = ratings::ColorMap::kThesis;
  bool emphasize_extremes = false;  // kMetric and kAggregate: all others are transparent
};

// Per mesh instance, absent where there is none: what its colour stands for. Of kAggregate, `rating` must be
// rated with ratings::Options::relative like the content.
std::vector<std::optional<double>> values(const Content& content, const ratings::SceneRating& rating);

// Whether values lie in [-1,1] instead of [0,1].
bool is_signed(const Content& content, const ratings::SceneRating& rating);

// The value from which on a mesh is extreme: the upper quarter of the range that the scene has. Absent
// without values.
std::optional<double> least_extreme(const std::vector<std::optional<double>>& values);

// One per mesh instance.
std::vector<scene_render::Look> looks(const Content& content, const ratings::SceneRating& rating);

// "Relative density", "Aggregate", "Planar groups", "Own colours".
std::string title(const Content& content);

}  // namespace scene_analyzer::pictures
