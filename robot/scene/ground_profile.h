#pragma once

#include "common/config/config_archive.h"
#include "common/core/error.h"
#include "common/geom/pose.h"
#include "common/robot_model/robot_geometry.h"

namespace kiln {

/// The way up to the building: start area, ramp, landing, edge, kitchen floor (z = 0 of map). A
/// profile along X of map, the same for every Y. All zero: flat.
struct ApproachConfig {
  double foot_x_m = 0.0, top_x_m = 0.0;  ///< the ramp rises between them
  double slope_deg = 0.0;                ///< of the ramp, upwards along +X
  double edge_x_m = 0.0;                 ///< step up to the kitchen floor; >= top_x_m
  double edge_m = 0.0;                   ///< its height
  void visit(ConfigArchive& a);
  [[nodiscard]] Result<void> validate() const;
};

/// Height of the ground under each point, and how a robot stands on it. Used by the simulator with
/// the true numbers and by whoever needs a first guess in 6 DoF with the nominal ones.
/// Thread-safe: constant.
class GroundProfile {
 public:
  GroundProfile() = default;  ///< flat, z = 0
  explicit GroundProfile(const ApproachConfig& approach);

  [[nodiscard]] double height(double x_m) const;  ///< metres in map
  [[nodiscard]] double lowest() const;            ///< of the start area; <= 0
  [[nodiscard]] double landing() const { return -approach_.edge_m; }
  [[nodiscard]] bool flat() const { return lowest() > -1e-6; }
  [[nodiscard]] const ApproachConfig& approach() const { return approach_; }

  /// The base with that position and heading in the plane, at rest on its four wheels: plane
  /// through the ground under them, lifted until none is below the ground. Exact on each of the
  /// flat pieces, within millimetres while the robot straddles the edge.
  [[nodiscard]] Eigen::Isometry3d standing(const Pose2& X_map_base,
                                           const RobotGeometry& robot) const;

 private:
  ApproachConfig approach_;
  double tangent_ = 0.0;
};

}  // namespace kiln
