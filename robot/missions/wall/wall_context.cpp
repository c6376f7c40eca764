#include "robot/missions/wall/wall_context.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/units.h"
#include "common/robot_model/robot_calibration.h"

namespace kiln {
namespace {

/// 0, -1, +1, -2, +2 ...: beside each other, the middle first.
double aside(int look) {
  const int step = (look + 1) / 2;
  return look % 2 == 1 ? -step : step;
}

std::string wallName(std::size_t built) { return fmt::format("wall brick {}", built + 1); }

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
      brick_look(look, wall_config.bricks, wall_config.brick_look.latency_s,
                 mission_parts.executor),
      marker(wall_config.marker, mission_parts),
      room_(StorageRoom::of(parts.robot)) {
  if (!parts.gripper || !parts.storage || !parts.arm_control) return;
  const HandlingParts handling{parts.robot, parts.arm, *parts.arm_control, parts.arm_device,
                               *parts.gripper};
  std::vector<std::string> rows;
  for (const CompartmentConfig& row : parts.robot.storage) rows.push_back(row.name);
  const LoadingConfig& loading = config.loading;
  hands.emplace(Hands{PickBrick(loading.pick, handling), PlaceBrick(loading.store, handling),
                      PickBrick(config.building.take_out, handling),
                      PlaceBrick(config.building.set, handling),
                      MoveStorage(loading.travel, *parts.storage, std::move(rows))});
}

Pose2 WallContext::X_map_pile() const {
  return belief.pile ? belief.pile->X_map_frame : site.pile.pose();
}
Pose2 WallContext::X_map_wall() const {
  return belief.wall ? belief.wall->X_map_frame : site.marker.pose();
}

Pose2 WallContext::pileLookPose(int index) const {
  const double length_m = site.layout().length();
  return before(X_map_pile(), length_m * (0.5 + 0.4 * aside(index)), config.pile_look.distance_m);
}

Pose2 WallContext::markerLookPose(int index) const {
  constexpr double kStep_m = 0.8;
  return before(X_map_wall(), 0.5 * kMarkerLength_m + kStep_m * aside(index),
                config.marker_look.distance_m);
}

ExpectedBricks WallContext::expectedBricks() const {
  const Pose2 X_base_map = inverse(parts.pose());
  ExpectedBricks out;
  out.target.X_base_target = toIsometry(X_base_map * X_map_pile());
  const std::vector<PileSlot> slots = site.layout().slots();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    bool far = false;
    if (i < belief.bricks.size()) {
      const PileBrick& brick = belief.bricks[i];
      if (brick.taken) continue;
      const Eigen::Vector3d p = toIsometry(X_base_map) * brick.X_map_brick.translation();
      far = p.head<2>().norm() > config.brick_look.far_m;
    }
    out.target.bricks.push_back({static_cast<int>(i), slots[i].kind, slots[i].X_pile_brick, far});
  }
  const double m = config.brick_look.wheels_m, rad = config.brick_look.wheels_deg * kDeg;
  if (belief.pile) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(X_base_map.yaw_rad).toRotationMatrix();
    out.covariance = turn * belief.pile->covariance * turn.transpose();
  }
  out.covariance.diagonal() += Eigen::Vector3d(m * m, m * m, rad * rad);
  return out;
}

std::size_t WallContext::toStore() const {
  if (!hands) return 0;
  return std::min(static_cast<std::size_t>(config.loading.bricks), load().storage.load.size());
}

bool WallContext::anyTaken() const {
  return std::any_of(belief.bricks.begin(), belief.bricks.end(),
                     [](const PileBrick& brick) { return brick.taken; });
}

bool WallContext::inStorage(std::size_t brick) const {
  const std::vector<StorageStep>& load = this->load().storage.load;
  const auto end = load.begin() + static_cast<std::ptrdiff_t>(belief.stored);
  return brick >= belief.taken_out && std::any_of(load.begin(), end, [&](const StorageStep& step) {
           return step.brick == brick;
         });
}

const StorageStep& WallContext::heldStep() const {
  const StoragePlan& storage = load().storage;
  return belief.unloading() ? storage.unload[belief.taken_out - 1] : storage.load[belief.stored];
}

Pose2 WallContext::buildingPose() const {
  std::size_t before = 0;
  const WallSlot& slot = plan.slots[load().slots[belief.built.size()]];
  const double away_m = config.building.distance_m;
  for (const BuildPosition& position : load().order.positions) {
    before += position.slots.size();
    if (belief.built.size() >= before) continue;
    // Who stands there sees the leg run from left to right.
    const Eigen::Vector3d p = slot.X_wall_brick.translation();
    const Pose2 X_wall_stand = slot.leg == WallLeg::Mixed
                                   ? Pose2{position.base_m, p.y() - away_m, M_PI / 2.0}
                                   : Pose2{p.x() + away_m, position.base_m, M_PI};
    return X_map_wall() * X_wall_stand;
  }
  return parts.pose();
}

Eigen::Isometry3d WallContext::X_wall_slot() const {
  return plan.slots[load().slots[belief.built.size()]].X_wall_brick;
}

std::optional<Eigen::Vector3d> WallContext::towardsNeighbour() const {
  const WallSlot& slot = plan.slots[load().slots[belief.built.size()]];
  const Eigen::Vector3d along =
      slot.leg == WallLeg::Mixed ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  for (std::size_t i = 0; i < belief.built.size(); ++i) {
    const WallSlot& other = plan.slots[load().slots[i]];
    if (other.layer != slot.layer) continue;
    if (other.index + 1 == slot.index) return -along;
    if (other.index == slot.index + 1) return along;
  }
  return std::nullopt;
}

ExpectedBricks WallContext::expectedWall() const {
  ExpectedBricks out;
  out.target.X_base_target = toIsometry(inverse(parts.pose()) * X_map_wall());
  for (std::size_t i = 0; i < belief.built.size(); ++i)
    out.target.bricks.push_back(
        {static_cast<int>(i), plan.slots[load().slots[i]].kind, belief.built[i], false});
  const double m = config.brick_look.wheels_m, rad = config.brick_look.wheels_deg * kDeg;
  out.covariance.diagonal() += Eigen::Vector3d(m * m, m * m, rad * rad);
  return out;
}

std::optional<std::size_t> WallContext::nextBrick() const {
  if (loaded()) return std::nullopt;
  const StoragePlan& storage = load().storage;
  const BrickKind kind = storage.sequence[storage.load[belief.stored].brick];
  const std::vector<PileSlot> slots = site.layout().slots();
  const Pose2 here = parts.pose();
  std::optional<std::size_t> best;
  double nearest_m = 0.0;
  for (std::size_t i = 0; i < belief.bricks.size() && i < slots.size(); ++i) {
    const PileBrick& brick = belief.bricks[i];
    if (brick.taken || brick.kind != kind || brick.state != BrickState::Found ||
        brick.confidence <= config.brick_look.trusted)
      continue;
    bool covered = false;
    for (std::size_t j = 0; j < belief.bricks.size() && j < slots.size(); ++j)
      covered |= slots[j].stack == slots[i].stack && slots[j].layer > slots[i].layer &&
                 !belief.bricks[j].taken && belief.bricks[j].state != BrickState::Missing;
    if (covered) continue;
    const Pose2 stand = takingPose(i);
    const double way_m = std::hypot(stand.x_m - here.x_m, stand.y_m - here.y_m);
    if (best && way_m >= nearest_m) continue;
    best = i;
    nearest_m = way_m;
  }
  return best;
}

Pose2 WallContext::stackLookPose(std::size_t pile_brick) const {
  const Eigen::Vector3d p = site.layout().slots()[pile_brick].X_pile_brick.translation();
  return X_map_pile() * Pose2{p.x(), p.y() - config.loading.look_m, M_PI / 2.0};
}

Pose2 WallContext::takingPose(std::size_t pile_brick) const {
  const PileSlot slot = site.layout().slots()[pile_brick];
  const Eigen::Vector3d p = slot.X_pile_brick.translation();
  return X_map_pile() *
         Pose2{p.x() + config.loading.left_m, p.y() - config.loading.reach_m, M_PI / 2.0};
}

bool WallContext::standsAt(const Pose2& X_map_stand) const {
  const Pose2 off = inverse(X_map_stand) * parts.pose();
  return std::hypot(off.x_m, off.y_m) <= config.loading.same_m &&
         std::abs(wrapAngle(off.yaw_rad)) <= config.loading.same_deg * kDeg;
}

bool WallContext::stoodSincePileLook() const {
  constexpr double kRest_m = 0.002, kRest_rad = 0.1 * kDeg;  // of wheel odometry at rest
  if (!pile_looked_from) return false;
  const Pose2 off = inverse(*pile_looked_from) * parts.pose();
  return std::hypot(off.x_m, off.y_m) <= kRest_m && std::abs(wrapAngle(off.yaw_rad)) <= kRest_rad;
}

KnownBrick WallContext::knownBrick(std::size_t pile_brick) const {
  const PileBrick& brick = belief.bricks[pile_brick];
  return {fmt::format("brick {}", pile_brick + 1), brick.kind,
          toIsometry(inverse(parts.pose())) * brick.X_map_brick};
}

StoragePosture WallContext::postureNow() const {
  StoragePosture posture;
  if (const auto state = parts.storage->state())
    for (const CompartmentState& row : state->compartments) posture.push_back(row.position_m);
  posture.resize(parts.robot.storage.size(), 0.0);
  return posture;
}

std::vector<StoredBrick> WallContext::storedBricks() const {
  const StoragePlan& storage = load().storage;
  std::vector<StoredBrick> stored;
  for (std::size_t i = 0; i < belief.stored; ++i)
    if (inStorage(storage.load[i].brick))
      stored.push_back({storage.sequence[storage.load[i].brick], storage.load[i].seat});
  return stored;
}

std::vector<OrientedBox> WallContext::storageNow() const {
  return hands ? storageAt(postureNow()) : std::vector<OrientedBox>();
}

std::vector<OrientedBox> WallContext::storageAt(const StoragePosture& posture) const {
  return storageBoxes(room_, posture, storedBricks());
}

std::vector<KnownBrick> WallContext::carriedBricks() const {
  std::vector<KnownBrick> out;
  if (!hands) return out;
  const StoragePosture posture = postureNow();
  for (const StoredBrick& brick : storedBricks())
    out.push_back({describe(room_, brick.seat), brick.kind,
                   X_base_stored(room_, posture, brick.seat, brick.kind)});
  const auto arm = parts.arm_device.state();
  if (const auto& held = belief.held; held && arm)
    out.push_back({held->name, held->kind,
                   parts.robot.X_base_flange(arm->q) * parts.robot.X_flange_tool.pose() *
                       held->X_tool_brick});
  return out;
}

std::vector<OrientedBox> WallContext::aroundHands() const {
  std::vector<KnownBrick> bricks;
  for (std::size_t i = 0; i < belief.bricks.size(); ++i)
    if (!belief.bricks[i].taken && belief.bricks[i].state != BrickState::Missing)
      bricks.push_back(knownBrick(i));
  const Eigen::Isometry3d X_base_wall = toIsometry(inverse(parts.pose()) * X_map_wall());
  for (std::size_t i = 0; i < belief.built.size(); ++i)
    bricks.push_back(
        {wallName(i), plan.slots[load().slots[i]].kind, X_base_wall * belief.built[i]});
  std::vector<OrientedBox> out = boxesOf(bricks);
  for (OrientedBox& box : storageNow()) out.push_back(std::move(box));
  return out;
}

Eigen::Isometry3d WallContext::X_base_seat(const StorageStep& step, const StoragePosture& posture,
                                           double out_m) const {
  return X_base_at(room_, posture, step.seat, load().storage.sequence[step.brick], out_m, 0.0);
}

std::vector<Eigen::Isometry3d> WallContext::seatWay(const StorageStep& step,
                                                    const StoragePosture& posture) const {
  return kiln::seatWay(room_, config.storage, posture, step.seat,
                       load().storage.sequence[step.brick]);
}

bool WallContext::somethingHangs() const {
  const auto gripper = parts.gripper ? parts.gripper->state() : std::nullopt;
  return gripper && gripper->on.any() && gripper->contact;
}

void WallContext::handleBricks() { parts.arena.fixtures[kWallSite].boxes.clear(); }

void WallContext::siteMoved() {
  WallSiteMap now = site;
  const auto config_of = [](const Pose2& X) {
    return GroundPoseConfig{{X.x_m, X.y_m}, X.yaw_rad / kDeg};
  };
  now.pile = config_of(X_map_pile());
  now.marker = config_of(X_map_wall());
  SiteFixtures fixtures = now.fixtures();
  for (std::size_t i = 0; i < belief.built.size(); ++i) {
    const double length_m = brickShape(plan.slots[load().slots[i]].kind).length_m;
    fixtures.boxes.push_back({wallName(i),
                              poseConfig(toIsometry(X_map_wall()) * belief.built[i]),
                              {length_m, kBrickSide_m, kBrickSide_m}});
  }
  parts.arena.fixtures[kWallSite] = std::move(fixtures);
}

void WallContext::halt() {
  drive.cancel();
  parts.arm.cancel();
  parts.base.cancel();
  if (hands) {
    hands->pick.cancel();
    hands->store.cancel();
    hands->take_out.cancel();
    hands->set.cancel();
    hands->travel.cancel();
  }
  ArmMoveTerms usual;
  usual.scene.boxes = storageNow();
  parts.arm.setTerms(std::move(usual));
  brick_look.cancel();
  look.cancel();
  pile.clear();
  marker.clear();
  siteMoved();
}

}  // namespace kiln
