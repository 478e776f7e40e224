// legend.h — What the colours of a picture mean: a strip below it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pictures/picture_content.h"
#include "ratings/ratings.h"

namespace scene_analyzer::pictures {

struct Legend {
  std::string title;
  std::vector<std::string> lines;                     // below the title, in small letters
  std::function<ratings::Rgb(double)> bar;            // colour along the bar, [0,1]; empty: there is none
  std::vector<std::pair<double, std::string>> ticks;  // where along the bar, and the text there
  std::optional<std::pair<double, double>>
      present;                 // the least and the greatest value of the scene, along the bar
  bool without_value = false;  // some meshes have no value
};

// `scene` is a short description for the small line: "room.glb".
Legend make_legend(const Content& content, const ratings::SceneRating& rating, const std::string& scene);

}  // namespace scene_analyzer::pictures
