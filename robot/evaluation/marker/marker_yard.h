#pragma once

#include <cstdint>

#include "robot/evaluation/marker/marker_picture.h"
#include "robot/evaluation/marker/marker_scene.h"

namespace kiln {

/// What a seed draws for one look at the marker.
struct MarkerYard {
  MarkerScene scene;
  HeadCamera camera;
  Pose2 X_map_start, X_map_end;  ///< the base drives from one to the other
};

/// A yard with the marker on level ground behind the slope of 3 degrees over 4 m, sun at 15 to 70
/// degrees from anywhere, things of similar colours (bricks on piles, an orange wall, patches of
/// yellow and of magenta, a person in a pink shirt and a yellow vest, crates, a fence), the robot
/// driving up to where it ends `distance_m` before the middle of the marker's square.
/// Nothing but MarkerCase hides the marker.
[[nodiscard]] MarkerYard drawYard(MarkerCase what, double distance_m, std::uint64_t seed);

}  // namespace kiln
