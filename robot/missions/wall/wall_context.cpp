#include "robot/missions/wall/wall_context.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln {
namespace {

/// 0, -1, +1, -2, +2 ...: beside each other, the middle first.
double aside(int look) {
  const int step = (look + 1) / 2;
  return look % 2 == 1 ? -step : step;
}

/// Before a line along X of the frame, at x, looking at it.
Pose2 before(const Pose2& X_map_frame, double x_m, double distance_m) {
  return X_map_frame * Pose2{x_m, -distance_m, M_PI / 2.0};
}

}  // namespace

WallContext::WallContext(const MissionParts& mission_parts, const WallConfig& wall_config,
                         const WallSiteMap& site_map, const WallPlan& wall_plan)
    : parts(mission_parts),
      config(wall_config),
      site(site_map),
      plan(wall_plan),
      drive(mission_parts, wall_config.stow_tolerance_deg * kDeg),
      look(wall_config.look, mission_parts),
      pile(wall_config.pile, site_map, mission_parts.executor),
      bricks(mission_parts.executor, "bricks", wall_config.brick_look.latency_s),
      marker(wall_config.marker, mission_parts) {}

Pose2 WallContext::X_map_pile() const {
  return belief.pile ? belief.pile->X_map_frame : site.pile.pose();
}
Pose2 WallContext::X_map_wall() const {
  return belief.wall ? belief.wall->X_map_frame : site.marker.pose();
}

Pose2 WallContext::pileLookPose(int look) const {
  const double length_m = site.layout().length();
  return before(X_map_pile(), length_m * (0.5 + 0.4 * aside(look)), config.pile_look.distance_m);
}

Pose2 WallContext::markerLookPose(int look) const {
  constexpr double kStep_m = 0.8;
  return before(X_map_wall(), 0.5 * kMarkerLength_m + kStep_m * aside(look),
                config.marker_look.distance_m);
}

ExpectedBricks WallContext::expectedBricks() const {
  const Pose2 X_base_map = inverse(parts.pose());
  ExpectedBricks out;
  out.target.X_base_target = toIsometry(X_base_map * X_map_pile());
  for (const PileSlot& slot : site.layout().slots())
    out.target.bricks.push_back(
        {static_cast<int>(out.target.bricks.size()), slot.kind, slot.X_pile_brick, false});
  const double m = config.brick_look.wheels_m, rad = config.brick_look.wheels_deg * kDeg;
  if (belief.pile) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(X_base_map.yaw_rad).toRotationMatrix();
    out.covariance = turn * belief.pile->covariance * turn.transpose();
  }
  out.covariance.diagonal() += Eigen::Vector3d(m * m, m * m, rad * rad);
  return out;
}

void WallContext::askForBricks(std::shared_ptr<const BrickSweep> sweep) {
  bricks.ask([config = config.bricks, sweep = std::move(sweep),
              target = expectedBricks().target]() -> Result<BrickSight> {
    return BrickPerception(config).perceive(*sweep, target);
  });
}

void WallContext::siteMoved() {
  WallSiteMap now = site;
  const auto config_of = [](const Pose2& X) {
    return GroundPoseConfig{{X.x_m, X.y_m}, X.yaw_rad / kDeg};
  };
  now.pile = config_of(X_map_pile());
  now.marker = config_of(X_map_wall());
  parts.arena.fixtures[kWallSite] = now.fixtures();
}

void WallContext::halt() {
  drive.cancel();
  parts.arm.cancel();
  parts.base.cancel();
  look.cancel();
  pile.clear();
  bricks.clear();
  marker.clear();
}

}  // namespace kiln
