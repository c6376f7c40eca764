#pragma once

#include <vector>

#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// A capsule of the true arm, for physics and rays; metres.
struct HullPart {
  const char* name;
  int link;                  ///< 1 to 6: moves with the Denavit-Hartenberg frame behind that joint
  Eigen::Vector3d from, to;  ///< its axis in that frame
  double radius;
  Material material;
};

/// The hull of a UR10e with a hose on it. Offsets beside the DH lines are those of the vendor's
/// model (shoulder 0.1762 m, elbow 0.0393 m), radii estimated from its joint sizes. The robot's own
/// description (bob.yaml) is another one and has to enclose this.
[[nodiscard]] const std::vector<HullPart>& armHull();

}  // namespace kiln::sim
