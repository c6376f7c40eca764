#include "robot/missions/wall/looking_posture.h"

#include "common/core/units.h"

namespace kiln {

// The wrist as it is, and not turned the other way as when stowed: so the head is farthest from
// the forearm.
Vector6d lookingPosture(double pan_rad, double tilt_rad) {
  Vector6d q;
  q << 180.0 * kDeg + pan_rad, -90.0 * kDeg, 60.0 * kDeg, -150.0 * kDeg + tilt_rad, -90.0 * kDeg,
      0.0;
  return q;
}

}  // namespace kiln
