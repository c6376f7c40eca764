#pragma once

#include <memory>

#include "common/model/sensor.h"
#include "robot/sim/scene_state.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// The operator's camera on the rear mast: sun, sky, shadows, glowing plate, flame and water. It
/// has a ray scene of its own, so that it may be used from another thread than the world. Confined
/// to one thread.
///
/// Rays are spent where they matter: one for each corner of 4 x 4 pixels; blocks whose corners see
/// one plane are filled by intersecting that plane, the others pixel by pixel.
class ColourCamera {
 public:
  ColourCamera(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot);
  ~ColourCamera();
  [[nodiscard]] RgbImagePtr render(const SceneState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::sim
