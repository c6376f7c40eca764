#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// What the live cloud says of a configured place.
enum class PlaceVerdict : std::uint8_t {
  Fits,       ///< stands where it was configured, within the normal scatter
  Misplaced,  ///< stands somewhere else: nothing scripted may be done there
  Unseen,     ///< too little of it was seen to tell
};
[[nodiscard]] std::string_view toString(PlaceVerdict verdict);  ///< "fits", "misplaced", "unseen"

/// Configured against sensed place of a fire box (NimbRo UGV paper: a wrongly configured place made
/// the arm collide with the box on competition day 1). Poses are of its front: origin in the middle
/// of the opening, in the outer face of the box; X out of the box, Z up.
struct PlaceCheck {
  Stamp stamp;  ///< of the newest scan that was looked at
  std::string place;
  Eigen::Isometry3d X_map_configured = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> X_map_sensed;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< of the sensed (x m, y m, yaw rad) in map
  double offset_m = 0.0;        ///< of the plate: sensed from configured, on the ground plane
  double yaw_offset_rad = 0.0;  ///< sensed minus configured
  double coverage = 0.0;        ///< share of the visible frame and table that points confirm, 0..1
  int points = 0;               ///< on the box and its table
  PlaceVerdict verdict = PlaceVerdict::Unseen;
  std::string reason;  ///< one sentence for the operator

  /// The nudge (command nudge_place) that would move the configured place onto the sensed one: (dx,
  /// dy) in map, yaw about the plate's vertical. Zero when nothing was sensed.
  /// @param recess_m  of the plate behind the opening.
  [[nodiscard]] Pose2 correction(double recess_m = 0.10) const;
};

}  // namespace kiln
