#include "robot/missions/fire/fire_mission.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/core/log.h"
#include "common/core/units.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "robot/missions/fire/fire_machine.h"
#include "robot/missions/fire/fire_report.h"
#include "robot/missions/fire/macro_steps.h"
#include "robot/missions/fire/skills/jet.h"

namespace kiln {
namespace {

constexpr double kPeakAge_s = 1.0;  ///< an older temperature is none

/// States in which the arm is, or will be at the next step, near the place.
bool worksAtPlace(const std::string& state) {
  for (const char* working : {"ArmSearch", "HeatFound", "AimHose", "LostTarget", "StartPump",
                              "SpraySteady", "SprayPattern", "StopPump", "PumpFault", "ArmBlocked"})
    if (state == working) return true;
  return false;
}

/// Rules of Challenge 3: 6 points for the first litre on the burning place. What is burning is
/// known by what was sprayed at, and litres are an estimate.
double scoreEstimate(const FireBelief& belief) {
  double best_l = 0.0;
  for (const FirePlace& place : belief.places) best_l = std::max(best_l, place.litres_est);
  return 6.0 * std::min(best_l, 1.0);
}

}  // namespace

struct FireMission::Impl {
  Impl(const FireDevices& devices, const FireConfig& config, const std::string& mission_uuid,
       Perception perception)
      : heat(std::move(perception.heat)),
        place(std::move(perception.place)),
        context(devices, config),
        machine(makeFireMachine(context, mission_uuid)) {}

  /// Litres go to the place that is being worked on, whoever runs the pumps.
  void countWater() {
    FireBelief& belief = context.belief;
    const PumpTracking pumps = context.devices.pumps.tracking();
    const double sprayed = std::max(0.0, pumps.sprayed_l_est - belief.sprayed_l_est);
    if (FirePlace* place = belief.currentPlace()) place->litres_est += sprayed;
    belief.sprayed_l_est = pumps.sprayed_l_est;
    belief.tank_l_est = pumps.tank_l_est;
  }

  void takeHeat(FireMission& mission) {
    const FireDevices& devices = context.devices;
    heat->dispatch();
    for (HeatTask::Result& result : heat->take()) {
      if (const auto X_map_flange = devices.X_map_flange(result.image->stamp)) {
        const Eigen::Isometry3d X_map_thermal =
            *X_map_flange * devices.robot.X_flange_thermal.pose();
        mission.onDetections(result.detections, X_map_thermal);
        report.addEstimate(heat->sweep().estimate(), result.detections.stamp, X_map_thermal);
      }
      devices.publish_thermal(result.image);
      peak_k = result.detections.usable ? result.detections.max_k : std::nan("");
      peak_stamp = result.detections.stamp;
      devices.publish_detail(wire::encodeDetail(result.detections));
    }
  }

  std::unique_ptr<HeatTask> heat;  ///< before the context, which holds what it makes
  std::unique_ptr<PlaceTask> place;
  FireContext context;
  FireReport report;
  std::unique_ptr<Machine> machine;
  double peak_k = std::nan("");  ///< of the newest image
  Stamp peak_stamp;
};

FireMission::FireMission(const FireDevices& devices, const FireConfig& config,
                         const std::string& mission_uuid, Perception perception)
    : impl_(std::make_unique<Impl>(devices, config, mission_uuid, std::move(perception))) {}
FireMission::~FireMission() = default;

Machine& FireMission::machine() { return *impl_->machine; }
const FireBelief& FireMission::belief() const { return impl_->context.belief; }
FireBelief& FireMission::belief() { return impl_->context.belief; }
const FireSiteMap& FireMission::siteMap() const { return impl_->context.site; }
double FireMission::limitS() const { return impl_->context.config.clock.limit_s; }

void FireMission::beginAnew(Stamp) {
  FireContext& c = impl_->context;
  FireBelief fresh = initialFireBelief(c.site);  // the water that was sprayed is gone
  fresh.sprayed_l_est = c.belief.sprayed_l_est;
  fresh.tank_l_est = c.belief.tank_l_est;
  c.belief = std::move(fresh);
  c.aim.reset();
  c.place_checks.clear();
  impl_->report = {};
}

void FireMission::observe(Stamp) {
  impl_->countWater();
  if (impl_->heat) impl_->takeHeat(*this);
  if (impl_->place) impl_->place->tick();
  for (const auto& [name, check] : impl_->context.place_checks) impl_->report.addPlaceCheck(check);
}

void FireMission::onDetections(const HeatDetections& detections,
                               const Eigen::Isometry3d& X_map_thermal) {
  FireContext& c = impl_->context;
  c.heat.onDetections(detections, X_map_thermal);
  if (c.heat.listening()) c.warming.add(detections, X_map_thermal);
}

void FireMission::onThermal(ThermalImagePtr image) {
  if (impl_->heat) impl_->heat->onThermal(std::move(image));
}

std::uint64_t FireMission::droppedFrames() const {
  return impl_->heat ? impl_->heat->droppedFrames() : 0;
}

void FireMission::onReset(Stamp now) {
  FireContext& c = impl_->context;
  c.belief.inside = false;
  c.belief.at_place = c.belief.current_place = -1;
  c.belief.entry_faults = c.belief.blocked_in_row = 0;
  c.aim.reset();
  if (impl_->place) impl_->place->clear();
  c.haltAll(now);
}

nlohmann::json FireMission::save() const { return fireBeliefToJson(impl_->context.belief); }

Result<void> FireMission::restore(const nlohmann::json& saved) {
  FireContext& c = impl_->context;
  auto belief = fireBeliefFromJson(saved, c.site.places.size());
  if (!belief) return tl::make_unexpected(belief.error());
  c.belief = std::move(*belief);
  c.devices.pumps.restoreEstimate(c.belief.sprayed_l_est, c.belief.tank_l_est);
  for (std::size_t i = 0; i < c.belief.places.size(); ++i) c.placeMoved(i);
  return {};
}

MissionInfo FireMission::info() const {
  const NudgeConfig& nudge = impl_->context.config.nudge;
  return fire::missionInfo(nudge.max_m, nudge.max_deg);
}

Result<void> FireMission::command(const MissionCommand& command, const std::string& operator_name,
                                  Stamp now) {
  if (command.name == fire::kContinueDespite)
    return continueDespite(command.target, operator_name, now);
  if (command.name != fire::kNudgePlace) return Mission::command(command, operator_name, now);
  Pose2 by;
  for (const auto& [name, value] : command.arguments) {
    if (name == "x") by.x_m = value;
    if (name == "y") by.y_m = value;
    if (name == "yaw") by.yaw_rad = value * kDeg;
  }
  return nudgePlace(command.target, by);
}

Result<void> FireMission::nudgePlace(const std::string& name, const Pose2& by) {
  Impl& m = *impl_;
  const auto& places = m.context.belief.places;
  const auto found = std::find_if(places.begin(), places.end(),
                                  [&](const FirePlace& place) { return place.name == name; });
  if (found == places.end())
    return makeError(ErrorCode::InvalidInput, "there is no fire place '{}'", name);
  const FsmStatus fsm = m.machine->status(m.context.devices.clock.now());
  const bool current = &*found == m.context.belief.currentPlace();
  if (current && fsm.running && !fsm.paused && worksAtPlace(fsm.state))
    return makeError(ErrorCode::Refused, "the arm works before {} ({}); pause the mission first",
                     name, fsm.state);
  const auto index = static_cast<std::size_t>(found - places.begin());
  if (auto moved = m.context.belief.nudgePlace(index, by); !moved) return moved;
  m.context.placeMoved(index);
  if (const auto check = m.context.place_checks.find(name); check != m.context.place_checks.end())
    check->second.X_map_configured =
        m.context.site.front(places[index].p_plate_map, places[index].facing_rad);
  logger("mission.fire")
      ->warn("{} was nudged by {:.2f}, {:.2f} m and {:.1f} deg", name, by.x_m, by.y_m,
             by.yaw_rad / kDeg);
  return {};
}

Result<void> FireMission::continueDespite(const std::string& subject,
                                          const std::string& operator_name, Stamp now) {
  Impl& m = *impl_;
  const FsmStatus fsm = m.machine->status(now);
  const FirePlace* place = m.context.belief.currentPlace();
  if (fsm.state != "PlaceRefused" || !place || place->name != subject)
    return makeError(ErrorCode::Refused, "no check objects to '{}' now", subject);
  const ChangeStateResult changed =
      m.machine->changeState({fsm.state, fsm.step, "ArmSearch"}, operator_name, now);
  if (changed.outcome != ChangeStateOutcome::Ok)
    return makeError(ErrorCode::Refused, "{}", changed.reason);
  return {};
}

std::vector<PlaceCheck> FireMission::placeChecks() const {
  std::vector<PlaceCheck> out;
  for (const auto& [name, check] : impl_->context.place_checks) out.push_back(check);
  return out;
}

MacroStepKinds FireMission::macroSteps(const MacroConfig& config) const {
  return fireMacroSteps(impl_->context, config);
}

std::optional<Pose2> FireMission::workPose(const std::string& place) const {
  const FirePlaceConfig* known = impl_->context.site.place(place);
  return known ? std::optional(known->work_pose.pose()) : std::nullopt;
}

std::vector<MissionAlarm> FireMission::alarms(Stamp now) const {
  std::vector<MissionAlarm> out;
  const FsmStatus fsm = impl_->machine->status(now);
  if (fsm.running && fsm.state == "PlaceRefused")
    out.push_back({"place.refused", AlarmLevel::Caution, fsm.display_text,
                   "compare configured and sensed outline, nudge the place or force Arm search"});
  const std::string late = impl_->heat ? impl_->heat->late(now) : std::string();
  if (fsm.running && !late.empty())
    out.push_back({"heat.late", AlarmLevel::Warning, "Perception does not deliver: " + late,
                   "the picture is old: do not aim by it; restart the daemon"});
  return out;
}

std::vector<Check> FireMission::checks(Stamp now) const {
  return impl_->heat ? impl_->heat->checks(now) : std::vector<Check>{};
}

std::vector<Figure> FireMission::figures(Stamp now) const {
  const PumpTracking pumps = impl_->context.devices.pumps.tracking();
  const bool known = toSeconds(now - impl_->peak_stamp) < kPeakAge_s;
  return fire::figures({pumps.duty, pumps.current_a, pumps.tank_l_est, pumps.sprayed_l_est},
                       scoreEstimate(impl_->context.belief), known ? impl_->peak_k : std::nan(""));
}

FireSite FireMission::site(Stamp now) const {
  FireContext& c = impl_->context;
  FireSite site;
  site.stamp = now;
  site.place_checks = placeChecks();
  const FirePlace* current = c.belief.currentPlace();
  site.footprint_m = {c.devices.robot.length_m, c.devices.robot.width_m};
  for (const FirePlace& place : c.belief.places) {
    site.places.push_back({place.name, place.p_plate_map, place.facing_rad, place.visited,
                           place.nudge, workPose(place.name)});
    std::optional<FireEstimate> estimate = place.estimate;
    if (&place == current && c.heat.listening()) estimate = c.estimate();
    if (estimate) site.fires.push_back(*estimate);
  }
  site.spraying = c.devices.pumps.tracking().spraying;
  if (const auto X_map_nozzle = c.X_map_nozzle())
    site.jet_map = jetPoints(c.calibration, *X_map_nozzle, c.hasPlace() ? c.flowScale() : 1.0);
  return site;
}

void FireMission::describe(Scene& scene, Stamp now) const {
  const FireSite known = site(now);
  scene.items = fire::sceneItems(known);
  scene.detail = wire::encodeDetail(known);
}

void FireMission::report(nlohmann::json& report) const {
  report["litres_est"] = impl_->context.belief.sprayed_l_est;
  impl_->report.write(report);
}

}  // namespace kiln
