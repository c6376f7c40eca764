#include "robot/missions/fire/skills/spray_pattern.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln {
namespace {

/// Tilts the nozzle about its exit: left is positive about Z, up is negative about Y.
Eigen::Isometry3d tilted(const Eigen::Isometry3d& X_map_nozzle, double left_rad, double up_rad) {
  Eigen::Isometry3d X = X_map_nozzle;
  X.linear() = X_map_nozzle.linear() * (Eigen::AngleAxisd(left_rad, Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(-up_rad, Eigen::Vector3d::UnitY()))
                                           .toRotationMatrix();
  return X;
}

}  // namespace

void SprayPatternConfig::visit(ConfigArchive& a) {
  a.field("half_width_deg", half_width_deg, "deg", 0.0, 15.0, "tilt to either side");
  a.field("half_height_deg", half_height_deg, "deg", 0.0, 15.0, "tilt up and down");
  a.field("points_per_edge", points_per_edge, "", 1, 50, "poses along each edge of the hourglass");
}

std::vector<Eigen::Isometry3d> hourglass(const Eigen::Isometry3d& X_map_nozzle,
                                         const SprayPatternConfig& config) {
  const double w = config.half_width_deg * kDeg;
  const double h = config.half_height_deg * kDeg;
  const std::vector<Eigen::Vector2d> corners{{w, h}, {-w, h}, {w, -h}, {-w, -h}, {w, h}};
  std::vector<Eigen::Isometry3d> out{tilted(X_map_nozzle, w, h)};
  for (std::size_t edge = 1; edge < corners.size(); ++edge)
    for (int i = 1; i <= config.points_per_edge; ++i) {
      const double s = static_cast<double>(i) / config.points_per_edge;
      const Eigen::Vector2d tilt = (1.0 - s) * corners[edge - 1] + s * corners[edge];
      out.push_back(tilted(X_map_nozzle, tilt.x(), tilt.y()));
    }
  return out;
}

}  // namespace kiln
