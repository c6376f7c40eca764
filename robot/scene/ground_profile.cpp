#include "robot/scene/ground_profile.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "common/core/units.h"

namespace kiln {
void ApproachConfig::visit(ConfigArchive& a) {
  a.field("foot_x_m", foot_x_m, "m", -1e3, 1e3, "the ramp begins here");
  a.field("top_x_m", top_x_m, "m", -1e3, 1e3,
          "the ramp ends here, one edge below the kitchen floor");
  a.field("slope_deg", slope_deg, "deg", 0, 15, "of the ramp, upwards along X");
  a.field("edge_x_m", edge_x_m, "m", -1e3, 1e3, "step up to the kitchen floor");
  a.field("edge_m", edge_m, "m", 0, 0.1, "height of that step");
}

Result<void> ApproachConfig::validate() const {
  if (top_x_m < foot_x_m || edge_x_m < top_x_m) {
    return makeError(ErrorCode::InvalidInput,
                     "approach: ramp from x = {} to {} m and edge at {} m; they must come in this "
                     "order along X",
                     foot_x_m, top_x_m, edge_x_m);
  }
  return {};
}

GroundProfile::GroundProfile(const ApproachConfig& approach)
    : approach_(approach), tangent_(std::tan(approach.slope_deg * kDeg)) {}

double GroundProfile::height(double x) const {
  if (x >= approach_.edge_x_m) return 0.0;
  const double below_top = approach_.top_x_m - std::max(x, approach_.foot_x_m);
  return landing() - tangent_ * std::max(0.0, below_top);
}

double GroundProfile::lowest() const {
  return landing() - tangent_ * (approach_.top_x_m - approach_.foot_x_m);
}

Eigen::Isometry3d GroundProfile::standing(const Pose2& X, const RobotGeometry& robot) const {
  const double c = std::cos(X.yaw_rad), s = std::sin(X.yaw_rad);
  Eigen::Matrix<double, 4, 3> offset;  // wheel contacts about the base, in map; last column 1
  Eigen::Vector4d z;
  for (int i = 0; i < 4; ++i) {
    const double x = i < 2 ? robot.wheel_x_m : -robot.wheel_x_m;
    const double y = i % 2 == 0 ? robot.wheel_y_m : -robot.wheel_y_m;
    offset.row(i) << c * x - s * y, s * x + c * y, 1.0;
    z[i] = height(X.x_m + offset(i, 0));
  }
  Eigen::Vector3d plane = offset.colPivHouseholderQr().solve(z);  // z = p0 dx + p1 dy + p2
  plane[2] += (z - offset * plane).maxCoeff();
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.translation() = Eigen::Vector3d(X.x_m, X.y_m, plane[2]);
  out.linear() = frameFromXAndUp({c, s, plane[0] * c + plane[1] * s},
                                 Eigen::Vector3d(-plane[0], -plane[1], 1.0).normalized());
  return out;
}

}  // namespace kiln
