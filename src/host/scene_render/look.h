// look.h — How one mesh instance looks.
#pragma once

#include "ratings/ratings.h"

namespace scene_analyzer::scene_render {

struct Look {
  enum class Fill {
    kColor,       // `color`; mixed with the luminance of its own colour where it has one
    kNoValue,     // neutral grey, hatched
    kOwnColor,    // what the file says; light grey where it says nothing
    kGroups,      // planar groups; kNoValue where they are not known
    kUnlitColor,  // `color` to the last bit, whatever the light: for telling meshes apart
  };
  Fill fill = Fill::kNoValue;
  ratings::Rgb color{};
  bool edges = false;  // of its triangles, over it; see SceneRenderer::can_draw_edges()
  double opacity = 1;  // below 1 it hides nothing
};

inline constexpr ratings::Rgb kNoValueGrey = {0.6, 0.6, 0.6};  // stripes are darker
inline constexpr double kStripe = 0.8;                         // times the grey

}  // namespace scene_analyzer::scene_render
