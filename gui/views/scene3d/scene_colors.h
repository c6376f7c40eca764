#pragma once

#include <array>

#include "gui/views/color/perceptual_map.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Colours of the scene.
struct SceneColors {
  bool dark = true;
  Rgb ground, grid, wall, wall_edge, furniture;
  Rgb body, body_edge, arm, joint, wheel, head;
  Rgb map_points, map_points_idle;  ///< of the part in use, and of the others
  Rgb planned, waypoint;
  std::array<Rgb, 4> driven{};  ///< a new one after each reset, then from the start again
  Rgb place, fire, fire_uncertainty, jet, jet_predicted;
  Rgb suspected;  ///< a place that may burn and has not been visited
  Rgb sensed;     ///< what the cloud says of a place
  Rgb intent;     ///< what the operator is about to do
  Rgb caution, text, text_dim, panel, panel_edge;

  /// The meanings come from the theme; solids and the cloud have shades of their own, one set a
  /// kind.
  [[nodiscard]] static SceneColors of(const Theme& theme);
};

}  // namespace kiln::gui
