#pragma once

#include "common/core/stamp.h"
#include "robot/sim/scene_state.h"

namespace kiln::sim {

class Physics;
class SensorSuite;
struct Truth;

/// What one mission's site does in the world, beside standing there (TrueArena): what happens at
/// it, what that scores, and what of it is told to referees. Confined to the world's thread.
class WorldPart {
 public:
  virtual ~WorldPart() = default;
  /// The mission's clock began; once.
  virtual void startClock(Stamp now) = 0;
  /// After the bodies of a step. @param scene  the world as it is then.
  virtual void step(Stamp now, double step_s, const Physics& physics, SensorSuite& sensors,
                    const SceneState& scene) = 0;
  /// Adds what sensors see of it.
  virtual void show(SceneState& state, Stamp now) const = 0;
  /// Adds its truth, and its points to the score.
  virtual void tell(Truth& truth) const = 0;
};

}  // namespace kiln::sim
