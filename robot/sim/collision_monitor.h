#pragma once

#include <vector>

#include "robot/sim/physics.h"
#include "robot/sim/world.h"

namespace kiln::sim {

/// Contacts of the robot, or of what it holds, with anything but wheels on ground and what is
/// planned (BodyContact), above a force (scenario.md section 5).
/// One entry a touch: the same pair counts again only after a second apart.
class CollisionMonitor {
 public:
  explicit CollisionMonitor(double threshold_n) : threshold_n_(threshold_n) {}
  void observe(Stamp now, const std::vector<BodyContact>& contacts);
  [[nodiscard]] const std::vector<Collision>& collisions() const { return collisions_; }

 private:
  double threshold_n_;
  std::vector<Collision> collisions_;
  std::vector<Stamp> last_seen_;  ///< by collision
};

}  // namespace kiln::sim
