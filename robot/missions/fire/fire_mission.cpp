#include "robot/missions/fire/fire_mission.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/log.h"
#include "robot/fsm/uuid.h"
#include "robot/missions/common/mission_checkpoint.h"
#include "robot/missions/fire/fire_machine.h"
#include "robot/missions/mapping/mapping_machine.h"
#include "robot/skills/aim/jet.h"
#include "robot/world_model/checkpoint_writer.h"

namespace kiln {
namespace {

/// States in which the arm is, or will be at the next step, near the place.
bool worksAtPlace(const std::string& state) {
  for (const char* working : {"ArmSearch", "HeatFound", "AimHose", "LostTarget", "StartPump",
                              "SpraySteady", "SprayPattern", "StopPump", "PumpFault", "ArmBlocked"})
    if (state == working) return true;
  return false;
}

bool sameHolds(const std::vector<MissionHold>& a, const std::vector<MissionHold>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.reason == y.reason && x.text == y.text;
  });
}

}  // namespace

WorldState initialWorld(const ArenaMap& arena) {
  WorldState world;
  world.X_map_base = arena.start.pose();
  for (const FirePlaceConfig& config : arena.fire_places) {
    FirePlace place;
    place.name = config.name;
    place.p_plate_map = {config.plate_xyz_m[0], config.plate_xyz_m[1], config.plate_xyz_m[2]};
    place.facing_rad = config.facing_deg * M_PI / 180.0;
    world.places.push_back(place);
  }
  return world;
}

struct FireMission::Impl {
  Impl(const FireDevices& devices, const FireConfig& config, const SprayCalibration& calibration,
       const Options& mission_options)
      : options(mission_options),
        writer(options.checkpoint_path.empty()
                   ? nullptr
                   : std::make_unique<CheckpointWriter>(options.checkpoint_path)),
        context(devices, config, calibration),
        mapping{devices.clock, devices.arena,       context.drive,
                devices.pose,  config.drive.rest_s, config.drive.max_faults},
        machine(options.mission == "mapping" ? makeMappingMachine(mapping, options.mission_uuid)
                                             : makeFireMachine(context, options.mission_uuid)) {
    machine->onTransition([this](const FsmCheckpoint& fsm) { save(fsm, true); });
  }

  /// Litres go to the place that is being worked on, whoever runs the pumps.
  void countWater() {
    WorldState& world = context.world();
    const PumpTracking pumps = context.devices.pumps.tracking();
    const double sprayed = std::max(0.0, pumps.sprayed_l_est - world.sprayed_l_est);
    if (FirePlace* place = context.devices.world.currentPlace()) place->litres_est += sprayed;
    world.sprayed_l_est = pumps.sprayed_l_est;
    world.tank_l_est = pumps.tank_l_est;
  }

  void observe(Stamp now) {
    WorldState& world = context.world();
    world.X_map_base = context.devices.pose();
    world.pose_stamp = now;
    countWater();
  }

  void save(const FsmCheckpoint& fsm, bool durable) {
    last_save = context.devices.clock.now();
    if (writer)
      writer->write(encodeCheckpoint({last_save, fsm, context.devices.world.state(), saved_holds}),
                    durable);
  }

  void placeMoved(std::size_t index) {
    const FirePlace& place = context.world().places[index];
    context.devices.move_place(index, place.p_plate_map, place.facing_rad);
  }

  /// A full disk costs the resume, not the mission.
  void watchStorage(Stamp now) {
    const std::optional<Error> problem = writer ? writer->problem() : std::nullopt;
    if (problem && !storage_alarm) {
      logger("mission.fire")->error("checkpoint not kept: {}", problem->message);
      storage_alarm = Alarm{"storage.checkpoint", AlarmLevel::Caution, problem->message,
                            "The mission goes on but could not be resumed; free the disk", now};
    }
    if (!problem) storage_alarm.reset();
  }

  const Options options;
  std::unique_ptr<CheckpointWriter> writer;
  FireContext context;
  MappingContext mapping;
  std::unique_ptr<Machine> machine;
  std::optional<Alarm> storage_alarm;
  Stamp last_save;
  std::function<std::vector<MissionHold>()> holds = [] { return std::vector<MissionHold>{}; };
  std::vector<MissionHold> saved_holds, restored_holds;
};

FireMission::FireMission(const FireDevices& devices, const FireConfig& config,
                         const SprayCalibration& calibration, const Options& options)
    : impl_(std::make_unique<Impl>(devices, config, calibration, options)) {}
FireMission::~FireMission() = default;

Machine& FireMission::machine() { return *impl_->machine; }
const Machine& FireMission::machine() const { return *impl_->machine; }

void FireMission::start(Stamp now) {
  Impl& m = *impl_;
  if (m.machine->begun()) {  // a mission after another: nothing was done yet, the water is gone
    WorldState fresh = initialWorld(m.context.devices.arena);
    const WorldState& before = m.context.world();
    fresh.resets = before.resets;
    fresh.sprayed_l_est = before.sprayed_l_est;
    fresh.tank_l_est = before.tank_l_est;
    m.context.devices.world.edit() = std::move(fresh);
    m.context.aim.reset();
    m.context.place_checks.clear();
    m.mapping.passed = 0;
    m.mapping.faults = 0;
  }
  m.context.devices.world.startClock(now);
  m.machine->start(m.machine->begun() ? randomUuid() : std::string(), now);
}

void FireMission::tick(Stamp now) {
  Impl& m = *impl_;
  m.observe(now);
  m.machine->step(now);
  const bool running = m.machine->running();
  if (auto holds = m.holds(); running && !sameHolds(holds, m.saved_holds)) {
    m.saved_holds = std::move(holds);
    m.save(m.machine->checkpoint(), true);
  }
  if (running && now - m.last_save >= fromSeconds(m.context.config.checkpoint_period_s))
    m.save(m.machine->checkpoint(), false);
  m.watchStorage(now);
  m.context.devices.world.publish();
}

void FireMission::flushCheckpoint() {
  if (impl_->writer) impl_->writer->flush();
}

void FireMission::onDetections(const HeatDetections& detections,
                               const Eigen::Isometry3d& X_map_thermal) {
  impl_->context.heat.onDetections(detections, X_map_thermal);
}

void FireMission::onReset(Stamp now) {
  Impl& m = *impl_;
  WorldState& world = m.context.world();
  ++world.resets;
  world.inside = false;
  world.at_place = world.current_place = -1;
  world.entry_faults = world.blocked_in_row = 0;
  m.context.aim.reset();
  m.mapping.passed = 0;
  m.context.haltAll(now);
  if (m.machine->status(now).running)
    m.machine->restart(fmt::format("reset {}", world.resets), now);
}

Result<void> FireMission::resumeFrom(const std::string& path, Stamp now) {
  Impl& m = *impl_;
  auto loaded = loadCheckpoint(path);
  if (!loaded) return tl::make_unexpected(loaded.error());
  const std::size_t places = m.context.devices.arena.fire_places.size();
  if (loaded->world.places.size() != places ||
      loaded->world.current_place >= static_cast<int>(places) ||
      loaded->world.at_place >= static_cast<int>(places))
    return makeError(
        ErrorCode::InvalidInput,
        "{}: the checkpoint knows {} fire places, the arena has {}; start without --resume", path,
        loaded->world.places.size(), places);
  m.restored_holds = loaded->holds;
  WorldState before = m.context.world();
  m.context.devices.world.restore(std::move(loaded->world), loaded->stamp, now);
  m.context.devices.pumps.restoreEstimate(m.context.world().sprayed_l_est,
                                          m.context.world().tank_l_est);
  auto restored = m.machine->restore(loaded->fsm, now);
  if (!restored) m.context.world() = std::move(before);
  for (std::size_t i = 0; i < places; ++i) m.placeMoved(i);
  return restored;
}

void FireMission::keepHolds(std::function<std::vector<MissionHold>()> holds) {
  impl_->holds = std::move(holds);
}

const std::vector<MissionHold>& FireMission::restoredHolds() const { return impl_->restored_holds; }

Result<void> FireMission::nudgePlace(const std::string& name, const Pose2& by) {
  Impl& m = *impl_;
  const auto& places = m.context.world().places;
  const auto found = std::find_if(places.begin(), places.end(),
                                  [&](const FirePlace& place) { return place.name == name; });
  if (found == places.end())
    return makeError(ErrorCode::InvalidInput, "there is no fire place '{}'", name);
  const FsmStatus fsm = m.machine->status(m.context.devices.clock.now());
  const bool current = &*found == m.context.devices.world.currentPlace();
  if (current && fsm.running && !fsm.paused && worksAtPlace(fsm.state))
    return makeError(ErrorCode::Refused, "the arm works before {} ({}); pause the mission first",
                     name, fsm.state);
  const auto index = static_cast<std::size_t>(found - places.begin());
  if (auto moved = m.context.devices.world.nudgePlace(index, by); !moved) return moved;
  m.placeMoved(index);
  if (const auto check = m.context.place_checks.find(name); check != m.context.place_checks.end())
    check->second.X_map_configured =
        m.context.devices.arena.front(places[index].p_plate_map, places[index].facing_rad);
  logger("mission.fire")
      ->warn("{} was nudged by {:.2f}, {:.2f} m and {:.1f} deg", name, by.x_m, by.y_m,
             by.yaw_rad * 180.0 / M_PI);
  return {};
}

Result<void> FireMission::continueDespite(const std::string& subject,
                                          const std::string& operator_name, Stamp now) {
  Impl& m = *impl_;
  const FsmStatus fsm = m.machine->status(now);
  const FirePlace* place = m.context.devices.world.currentPlace();
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

std::vector<FirePlaceInfo> FireMission::places() const {
  std::vector<FirePlaceInfo> out;
  for (const FirePlace& place : impl_->context.world().places)
    out.push_back({place.name, place.p_plate_map, place.facing_rad, place.visited, place.nudge});
  return out;
}

std::vector<FireEstimate> FireMission::fires() const {
  std::vector<FireEstimate> out;
  const FirePlace* current = impl_->context.devices.world.currentPlace();
  for (const FirePlace& place : impl_->context.world().places) {
    std::optional<FireEstimate> estimate = place.estimate;
    if (&place == current && impl_->context.heat.listening()) estimate = impl_->context.estimate();
    if (estimate) out.push_back(*estimate);
  }
  return out;
}

JetPreview FireMission::jetPreview(Stamp now) const {
  const FireContext& c = impl_->context;
  JetPreview out;
  out.stamp = now;
  out.spraying = c.devices.pumps.tracking().spraying;
  const auto X_map_nozzle = c.X_map_nozzle();
  if (X_map_nozzle)
    out.points_map = jetPoints(c.calibration, *X_map_nozzle, c.hasPlace() ? c.flowScale() : 1.0);
  return out;
}

std::vector<Alarm> FireMission::alarms() const {
  if (!impl_->storage_alarm) return {};
  return {*impl_->storage_alarm};
}

}  // namespace kiln
