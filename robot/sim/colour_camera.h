#pragma once

#include <memory>

#include "common/model/sensor.h"
#include "robot/sim/scene_state.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// Which of the robot's colour cameras.
enum class CameraMount { Mast, Head };

/// A colour camera, the operator's on the rear mast or the one in the head: sun, sky, shadows,
/// glowing plate, flame and water. It has a ray scene of its own, so that it may be used from
/// another thread than the world. With auto_exposure its brightness follows the mean of what it saw
/// last, as a camera's own loop does. Confined to one thread.
///
/// Rays are spent where they matter: one for each corner of 4 x 4 pixels; blocks whose corners see
/// one plane are filled by intersecting that plane, the others pixel by pixel.
class ColourCamera {
 public:
  ColourCamera(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
               CameraMount mount = CameraMount::Mast);
  ~ColourCamera();
  [[nodiscard]] RgbImagePtr render(const SceneState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::sim
