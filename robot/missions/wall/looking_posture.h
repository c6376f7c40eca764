#pragma once

#include "common/model/sensor.h"

namespace kiln {

/// The head as a search for the marker holds it: the arm upright, camera 1.6 to 1.85 m above the ground,
/// 5 cm clear of the arm for tilts up to 42 degrees. Joints of the UR10e, rad.
/// @param pan_rad, tilt_rad  of the viewing direction: about Z of base; downwards.
[[nodiscard]] Vector6d lookingPosture(double pan_rad, double tilt_rad);

}  // namespace kiln
