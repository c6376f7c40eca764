#include "robot/evaluation/wall/pile_trial.h"

#include <utility>

#include "common/core/units.h"
#include "robot/evaluation/bricks/processor_clock.h"
#include "robot/perception/bricks/pile_detector.h"
#include "robot/scene/obstacles.h"

namespace kiln {
namespace {

constexpr double kBeside_m = 0.8;  // the pile may reach beyond what is known of its place
constexpr double kWheels_m = 0.03, kWheels_rad = 1.0 * kDeg;  // on the way to the stand

Error about(const char* what, const Error& error) {
  return Error{error.code, fmt::format("{}: {}", what, error.message)};
}

SearchArea areaOf(const WallSiteMap& site, const Pose2& X_map_base) {
  const double half = 0.5 * site.layout().length();
  const Pose2 X_base_pile = inverse(X_map_base) * site.pile.pose();
  SearchArea area;
  area.X_base_area = toIsometry(X_base_pile * Pose2{half, 0.0, 0.0});
  area.half_x_m = half + site.known_m + kBeside_m;
  area.half_y_m = site.known_m + kBeside_m;
  area.x_expected = toIsometry(X_base_pile).linear().col(0);
  return area;
}

Result<PileDetection> findPile(WallRig& rig, const ViewPlanner& planner,
                               const ViewPlanner::Reach& reach, const WallSiteMap& site) {
  const auto motion = planner.firstLook(reach);
  if (!motion) return tl::make_unexpected(about("the first look", motion.error()));
  const auto look = rig.sweep(*motion);
  if (!look) return tl::make_unexpected(about("the first look", look.error()));
  const auto search = PileDetector({}).detect(look->sweep, areaOf(site, rig.pose()), site.layout());
  if (!search) return tl::make_unexpected(about("the pile", search.error()));
  if (search->found.empty()) return makeError(ErrorCode::NotFound, "the pile: {}", search->why);
  return search->found.front();
}

BrickTarget targetOf(const WallSiteMap& site, const Pose2& X_base_pile) {
  BrickTarget out;
  for (const PileSlot& slot : site.layout().slots())
    out.bricks.push_back(
        {static_cast<int>(out.bricks.size()), slot.kind, slot.X_pile_brick, false});
  out.X_base_target = toIsometry(X_base_pile);
  return out;
}

/// Covariance of x, y, yaw in the axes of the base as it stands now.
Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, const Pose2& X_map_now,
                       const Pose2& X_map_then) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(X_map_then.yaw_rad - X_map_now.yaw_rad, Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  return R * covariance * R.transpose();
}

}  // namespace

Result<PileLook> lookAtPile(WallRig& rig, const RobotGeometry& robot, ArenaMap& arena,
                            WallSiteMap site, const PileLookOptions& options) {
  PileLook out;
  const ViewPlanner planner(options.views, robot);
  ArmCollision world(robot);
  world.setScene(obstacles(arena), rig.pose());
  const auto found = findPile(rig, planner, planner.reachOf(world, rig.joints()), site);
  if (!found) return tl::make_unexpected(found.error());
  const Pose2 X_base_found = projectToGround(found->X_base_pile);
  const Pose2 X_map_pile = rig.pose() * X_base_found, X_map_looked = rig.pose();
  out.X_start_pile = inverse(arena.start.pose()) * X_map_pile;
  const double half = 0.5 * site.layout().length();
  const Pose2 X_base_middle = X_base_found * Pose2{half, 0.0, 0.0};
  out.found_after_m = std::hypot(X_base_middle.x_m, X_base_middle.y_m);

  // From now on it stands where it was found, for arm and base.
  site.pile = {{X_map_pile.x_m, X_map_pile.y_m}, X_map_pile.yaw_rad / kDeg};
  arena.fixtures[kWallSite] = site.fixtures();
  const Pose2 stand{half, -(options.stand_m + 0.5 * kBrickSide_m), M_PI_2};
  if (auto there = rig.driveTo(X_map_pile * stand); !there)
    return tl::make_unexpected(about("the way to the pile", there.error()));

  ExpectedBricks expected{targetOf(site, inverse(rig.pose()) * X_map_pile),
                          turned(found->covariance, rig.pose(), X_map_looked)};
  expected.covariance.diagonal() += Eigen::Vector3d(kWheels_m, kWheels_m, kWheels_rad).cwiseAbs2();
  world.setScene(obstacles(arena), rig.pose());
  const ProcessorClock processor;
  const Stamp began = processor.now();
  auto plan = planner.plan(expected, planner.reachOf(world, rig.joints()));
  out.plan_s = toSeconds(processor.now() - began);
  if (!plan) return tl::make_unexpected(about("the views", plan.error()));
  if (plan->views.empty())
    return makeError(ErrorCode::Degenerate, "the views: none can be made; {}", plan->why);
  out.plan = std::move(*plan);
  BrickSweep all;
  for (const PlannedView& view : out.plan.views) {
    auto cloud = rig.sweep(view.motion);
    if (!cloud) return tl::make_unexpected(about("a sweep", cloud.error()));
    all.add(cloud->sweep);
    out.clouds.push_back(std::move(*cloud));
  }
  out.target = std::move(expected.target);
  auto sight = BrickPerception({}).perceive(all, out.target);
  if (!sight) return tl::make_unexpected(about("the bricks", sight.error()));
  out.sight = std::move(*sight);
  return out;
}

}  // namespace kiln
