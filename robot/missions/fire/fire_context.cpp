#include "robot/missions/fire/fire_context.h"

#include <cmath>
#include <utility>

#include "common/core/check.h"
#include "common/core/units.h"
#include "robot/missions/fire/skills/pose_step.h"

namespace kiln {
namespace {
constexpr double kBaseMoved_m = 0.10;  // more than a correction of the localisation
constexpr double kBaseMoved_rad = 0.09;
constexpr double kAtWorkPose_m = 0.5;  // near enough to reach the place with the arm
}  // namespace

FireContext::FireContext(const FireDevices& fire_devices, const FireConfig& fire_config)
    : devices(fire_devices),
      config(fire_config),
      site(fire_devices.site),
      belief(initialFireBelief(site)),
      heat(fire_devices.heat),
      warming(fire_config.search.warming),
      look(fire_config.search.motion, fire_devices.robot, fire_devices.arm),
      drive(fire_devices, fire_config.drive.stow_tolerance_deg * kDeg) {}

const FirePlace& FireContext::place() const {
  const FirePlace* current = belief.currentPlace();
  KILN_CHECK(current != nullptr);
  return *current;
}

FirePlace& FireContext::place() { return const_cast<FirePlace&>(std::as_const(*this).place()); }

void FireContext::placeMoved(std::size_t index) {
  site.movePlace(index, belief.places[index].p_plate_map, belief.places[index].facing_rad);
  devices.arena.fixtures[kFireSite] = site.fixtures();
}

Eigen::Isometry3d FireContext::placeFront() const {
  return site.front(place().p_plate_map, place().facing_rad);
}

std::string FireContext::whyNoPlace() const {
  return hasPlace() ? "" : "no fire place is selected; enter Next location first";
}

void FireContext::closePlace(const std::string& outcome) {
  place().visited = true;
  place().outcome = outcome;
}

Eigen::Isometry3d FireContext::X_map_base() const { return toIsometry(devices.pose()); }

std::optional<Eigen::Isometry3d> FireContext::X_base_flange() const {
  const std::optional<ArmState> state = devices.arm_device.state();
  if (!state) return std::nullopt;
  return devices.robot.X_base_flange(state->q);
}

std::optional<Eigen::Isometry3d> FireContext::X_map_nozzle() const {
  const auto X_flange = X_base_flange();
  if (!X_flange) return std::nullopt;
  return X_map_base() * *X_flange * devices.robot.X_flange_nozzle.pose();
}

Eigen::Isometry3d FireContext::flangeFor(const Eigen::Isometry3d& X_base_nozzle) const {
  return X_base_nozzle * devices.robot.X_flange_nozzle.pose().inverse();
}

Eigen::Isometry3d FireContext::flangeForNozzle(const Eigen::Isometry3d& X_map_nozzle) const {
  return flangeFor(X_map_base().inverse() * X_map_nozzle);
}

Eigen::Vector3d FireContext::placeNormal() const {
  const double yaw = place().facing_rad;
  return {std::cos(yaw), std::sin(yaw), 0.0};
}

std::optional<FireEstimate> FireContext::estimate() {
  const auto near = [this](const FireEstimate& candidate) {
    return (candidate.p_map - place().p_plate_map).norm() <= config.search.place_gate_m;
  };
  std::optional<FireEstimate> fresh = heat.estimate();
  if (fresh && near(*fresh)) {
    fresh->place = place().name;
    return fresh;
  }
  return place().estimate;
}

AimTarget FireContext::aimTarget(const FireEstimate& fire) const {
  return {fire.p_map, placeNormal(), site.recess_m};
}

double FireContext::flowScale() const {
  const PumpTracking pumps = devices.pumps.tracking();
  const FireBelief& w = belief;
  const double to_spray_l = std::max(0.0, config.spray.litres_per_fire - place().litres_est);
  const int running = static_cast<int>(w.pump_usable[0]) + static_cast<int>(w.pump_usable[1]);
  if (running == 0) return 1.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!w.pump_usable[i]) continue;
    const double level_l = pumps.tank_l_est[i] - 0.5 * to_spray_l / running;
    scale += calibration.flowScale(level_l / config.spray.tank_l) / running;
  }
  return scale;
}

bool FireContext::atSprayPose() const {
  const auto X_flange = X_base_flange();
  if (!aim || !X_flange) return false;
  const Pose2 moved = inverse(aim->X_map_base) * devices.pose();
  if (std::hypot(moved.x_m, moved.y_m) > kBaseMoved_m || std::abs(moved.yaw_rad) > kBaseMoved_rad)
    return false;
  return atPose(*X_flange * devices.robot.X_flange_nozzle.pose(), aim->X_base_nozzle(),
                config.aim.hold_tolerance_m, config.aim.hold_tolerance_deg * kDeg);
}

bool FireContext::atWorkPose() const {
  const int index = belief.current_place;
  if (index < 0) return false;
  const Pose2 work = site.places[static_cast<std::size_t>(index)].work_pose.pose();
  const Pose2 here = devices.pose();
  return std::hypot(here.x_m - work.x_m, here.y_m - work.y_m) <= kAtWorkPose_m;
}

void FireContext::pumpsOn(Stamp now) const {
  PumpSetpoint setpoint;
  setpoint.stamp = now;
  for (std::size_t i = 0; i < 2; ++i)
    setpoint.duty[i] = belief.pump_usable[i] ? config.spray.duty : 0.0;
  devices.pumps.setpoint(setpoint);
}

void FireContext::pumpsOff(Stamp now) const {
  PumpSetpoint setpoint;
  setpoint.stamp = now;
  devices.pumps.setpoint(setpoint);
}

void FireContext::haltMotion() {
  look.cancel();
  drive.cancel();
  devices.arm.cancel();
  devices.base.cancel();
}

void FireContext::haltAll(Stamp now) {
  haltMotion();
  pumpsOff(now);
}

}  // namespace kiln
