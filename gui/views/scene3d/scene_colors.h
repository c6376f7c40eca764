#pragma once

#include <array>

#include "common/model/scene.h"
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
  Rgb done, suspected, sensed, target, uncertainty, active, predicted;  ///< of ItemStyle
  Rgb intent;  ///< what the operator is about to do
  Rgb caution, text, text_dim, panel, panel_edge;

  /// The meanings come from the theme; solids and the cloud have shades of their own, one set a
  /// kind.
  [[nodiscard]] static SceneColors of(const Theme& theme);
  [[nodiscard]] Rgb item(ItemStyle style) const;
};

}  // namespace kiln::gui
