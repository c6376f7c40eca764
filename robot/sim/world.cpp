#include "robot/sim/world.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/config/resources.h"
#include "common/core/check.h"
#include "common/core/log.h"
#include "robot/scene/fire_site_map.h"
#include "robot/scene/wall_site_map.h"
#include "robot/sim/arm_device.h"
#include "robot/sim/arm_obstacle.h"
#include "robot/sim/base_device.h"
#include "robot/sim/collision_monitor.h"
#include "robot/sim/disturbances.h"
#include "robot/sim/fault_catalog.h"
#include "robot/sim/fault_script.h"
#include "robot/sim/fire_part.h"
#include "robot/sim/gripper_device.h"
#include "robot/sim/physics.h"
#include "robot/sim/pump_device.h"
#include "robot/sim/sensor_suite.h"
#include "robot/sim/storage_device.h"
#include "robot/sim/wall_part.h"

namespace kiln::sim {
namespace {

constexpr double kUprightCosine = 0.87;  // 30 degrees: beyond that no wheel saves it
constexpr double kSunk_m = 0.3;

}  // namespace

struct World::Impl {
  Impl(const WorldConfig& c, TrueArena drawn, const RobotGeometry& r, std::uint64_t s,
       Options options)
      : config(c),
        robot(r),
        seed(s),
        arena(std::move(drawn)),
        step(fromSeconds(c.physics.step_s)),
        faults(c.faults),
        arm(c.arm, r, arena.robot, s),
        base(c.base, r, arena.robot, s),
        pumps(c.water, s),
        gripper(c.wall.magnets, s),
        storage(c.wall.storage, r.storage, s),
        fire(c, arena, robot, pumps, s),
        wall(arena, robot),
        collisions(c.collision_force_n),
        disturbances(arena, r, s),
        sensors(c, arena, r, fire.wet(), s, options.render_colour),
        obstacle(robot),
        reduced_zones(arena.reducedZones(c.arm.reduced_zone_m)) {
    if (arena.wall.present() || !r.storage.empty()) parts.push_back(&wall);
  }

  void carryToStart();
  void stepOnce();
  void applyFaults();
  void noticeFall();
  /// Gripper and storage, before the bodies of a step.
  void controlBricks(double step_s);
  [[nodiscard]] SceneState scene() const;
  [[nodiscard]] Eigen::Isometry3d X_map_flange() const {
    return physics->X_map_base() * robot.X_base_flange(physics->armPosition());
  }

  WorldConfig config;
  RobotGeometry robot;
  std::uint64_t seed;
  TrueArena arena;
  Duration step;
  Stamp now;
  FaultScript faults;
  std::unique_ptr<Physics> physics;
  ArmDevice arm;
  BaseDevice base;
  PumpDevice pumps;
  GripperDevice gripper;
  StorageDevice storage;
  FirePart fire;
  WallPart wall;
  std::vector<WorldPart*> parts{&fire};
  CollisionMonitor collisions;
  Disturbances disturbances;
  SensorSuite sensors;
  ArmObstacle obstacle;
  std::vector<Eigen::AlignedBox2d> reduced_zones;
  bool protective_stop_done = false;
  std::optional<Stamp> fell;
  bool clock_runs = false;  ///< the mission's
  std::uint32_t resets = 0;
  std::vector<Pose2> starts;
  std::uint64_t seq = 0;
  std::string refused;
};

void World::Impl::carryToStart() {
  starts.push_back(drawStart(config.perturbation, arena.nominal_start, seed, resets));
  const Vector6d q = RobotGeometry::radians(robot.q_park_deg);
  physics->carryTo(arena.ground.standing(starts.back(), robot), q);
  arm.reset(now, q);
  base.reset();
}

SceneState World::Impl::scene() const {
  SceneState state;
  state.stamp = now;
  state.X_map_base = physics->X_map_base();
  state.q = physics->armPosition();
  for (std::size_t i = 0; i < 4; ++i) {
    state.steer_rad[i] = physics->steer(i).position;
    state.drive_rad[i] = physics->drive(i).position;
  }
  for (const WorldPart* part : parts) part->show(state, now);
  state.obstacle = obstacle.center();
  disturbances.show(state);
  return state;
}

void World::Impl::applyFaults() {
  const bool all = faults.active("pump_blocked", now);
  pumps.setBlocked(0, all || faults.active("pump_blocked_left", now));
  pumps.setBlocked(1, all || faults.active("pump_blocked_right", now));
  obstacle.step(faults.active("arm_obstacle", now), *physics);
  const bool stop = faults.active("protective_stop", now);
  if (stop && !protective_stop_done) arm.protectiveStop();
  protective_stop_done = stop;
  const FaultConfig* runaway = faults.find("runaway", now);
  base.setRunaway(runaway != nullptr ? faultValue(*runaway, 0) : 1.0,
                  runaway != nullptr ? faultValue(*runaway, 1) : 0.0);
  disturbances.step(faults, now, toSeconds(step), *physics);
  const FaultConfig* magnet = faults.find("magnet_broken", now);
  for (std::size_t i = 0; i < kMagnets; ++i)
    gripper.setBroken(i, magnet != nullptr && faultValue(*magnet, 0) == static_cast<double>(i + 1));
  const FaultConfig* jam = faults.find("storage_jammed", now);
  for (std::size_t i = 0; i < storage.size(); ++i)
    storage.setJammed(i, jam != nullptr && faultValue(*jam, 0) == static_cast<double>(i + 1));
}

void World::Impl::controlBricks(double dt) {
  gripper.setPowered(!base.batteryEmpty());
  gripper.step(dt);
  if (BrickBodies* bricks = physics->bricks()) bricks->setFields(gripper.fields());
  storage.setPowered(!base.batteryEmpty());
  storage.control(now, dt, *physics);
}

/// Nothing in the arena can bring the robot there without a collision; said apart, so that nobody
/// reads meaning into what comes after.
void World::Impl::noticeFall() {
  if (fell) return;
  const Eigen::Isometry3d X = physics->X_map_base();
  if (X.linear()(2, 2) > kUprightCosine && X.translation().z() > arena.ground.lowest() - kSunk_m)
    return;
  fell = now;
  logger("sim.world")
      ->error("the robot fell over at x {:.2f}, y {:.2f}; only a reset helps", X.translation().x(),
              X.translation().y());
}

void World::Impl::stepOnce() {
  const double dt = toSeconds(step);
  applyFaults();
  const Eigen::Vector3d p_map_tool = X_map_flange() * robot.X_flange_tool.pose().translation();
  const Eigen::Vector2d p_tool = p_map_tool.head<2>();
  arm.setReduced(std::any_of(reduced_zones.begin(), reduced_zones.end(),
                             [&](const auto& zone) { return zone.contains(p_tool); }));
  arm.setPowered(!base.batteryEmpty());
  arm.control(now, dt, *physics);
  base.control(now, dt, *physics);
  controlBricks(dt);
  physics->step();
  now += step;
  arm.sense(now, dt, *physics);
  collisions.observe(now, physics->contacts());
  noticeFall();
  const SceneState seen = scene();
  for (WorldPart* part : parts) part->step(now, dt, *physics, sensors, seen);
  sensors.afterStep(seen, faults, [this] { return fire.drops(); });
}

World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::~World() = default;

Result<std::unique_ptr<World>> World::create(const WorldConfig& config, std::uint64_t seed,
                                             Options options) {
  if (auto ok = config.validate(); !ok) return tl::make_unexpected(ok.error());
  const auto map = loadResource<ArenaMap>(config.arena);
  if (!map) return tl::make_unexpected(map.error());
  if (auto ok = map->approach.validate(); !ok) {
    return makeError(ErrorCode::InvalidInput, "{}: {}", config.arena, ok.error().message);
  }
  for (const WarmBoardConfig& board : config.warm_boards) {
    const auto named = [&](const BoxConfig& wall) { return wall.name == board.box; };
    if (std::none_of(map->walls.begin(), map->walls.end(), named))
      return makeError(ErrorCode::InvalidInput, "warm_boards: {} has no wall '{}'", config.arena,
                       board.box);
  }
  const auto robot = loadResource<RobotGeometry>(config.robot);
  if (!robot) return tl::make_unexpected(robot.error());
  const auto site = loadFireSite(*map);
  if (!site) return tl::make_unexpected(site.error());
  const auto wall_site = loadWallSite(*map);
  if (!wall_site) return tl::make_unexpected(wall_site.error());
  TrueArena arena = TrueArena::draw(config, *map, *site, *robot, seed);
  if (auto ok = arena.addWall(config, *wall_site, seed); !ok)
    return tl::make_unexpected(ok.error());
  auto impl = std::make_unique<Impl>(config, std::move(arena), *robot, seed, options);
  auto physics = Physics::create(config, impl->arena, *robot);
  if (!physics) return tl::make_unexpected(physics.error());
  impl->physics = std::move(*physics);
  impl->carryToStart();
  return std::unique_ptr<World>(new World(std::move(impl)));
}

void World::command(const WorldCommands& c) {
  Impl& w = *impl_;
  const auto note = [&w](std::string why) {
    if (!why.empty()) w.refused = std::move(why);
  };
  if (c.sensors) w.sensors.request(*c.sensors);
  if (c.payload) note(w.arm.setPayload(*c.payload));
  if (c.zero_force) w.arm.zeroForceSensor();
  if (c.release_protective_stop) {
    w.arm.releaseProtectiveStop();
    w.refused.clear();
  }
  if (c.request_reset) {
    ++w.resets;
    w.carryToStart();
  }
  if (c.start_clock && !w.clock_runs) {
    w.clock_runs = true;
    for (WorldPart* part : w.parts) part->startClock(w.now);
  }
  if (c.arm) note(w.arm.servo(w.now, c.arm->q, c.arm->qd, c.arm_sent));
  if (c.base) note(w.base.write(w.now, *c.base));
  if (c.pumps) note(w.pumps.write(w.now, *c.pumps));
  if (c.magnets) w.gripper.write(*c.magnets);
  if (c.storage) note(w.storage.write(w.now, *c.storage));
}

WorldReport World::advance(Stamp until) {
  Impl& w = *impl_;
  KILN_CHECK(until >= w.now - w.step, toSeconds(until), toSeconds(w.now));
  while (w.now + w.step <= until) w.stepOnce();
  WorldReport report;
  report.now = w.now;
  report.seq = ++w.seq;
  report.arm = w.arm.report(w.now, *w.physics);
  report.base = w.base.report(w.now, *w.physics);
  report.pumps = w.pumps.report(w.now);
  if (const BrickBodies* bricks = w.physics->bricks()) {
    const GripState& grip = bricks->grip();
    report.gripper = w.gripper.report(w.now, grip.held || grip.touched);
  }
  if (w.storage.size() > 0) report.storage = w.storage.report(w.now, *w.physics);
  report.resets = w.resets;
  report.refused = w.refused;
  w.sensors.takeFrames(report);
  return report;
}

Stamp World::now() const { return impl_->now; }
std::optional<SceneState> World::colourDue(CameraMount camera) {
  return impl_->sensors.takeColourDue(camera);
}

DeviceSet World::devices() const {
  using enum DeviceKind;
  DeviceSet out{Pumps, Lidar, ThermalCamera, OperatorCamera};
  if (impl_->physics->bricks() != nullptr) out.insert({Gripper, HeadCamera});
  if (!impl_->robot.storage.empty()) out.insert(Storage);
  std::istringstream words(impl_->config.without);
  for (std::string word; words >> word;) out.erase(*deviceNamed(word));
  return out;
}

std::size_t World::awakeBricks() const {
  const BrickBodies* bricks = impl_->physics->bricks();
  return bricks == nullptr ? 0 : bricks->awake();
}

std::uint64_t World::seed() const { return impl_->seed; }
const WorldConfig& World::config() const { return impl_->config; }
const TrueArena& World::arena() const { return impl_->arena; }
const RobotGeometry& World::robot() const { return impl_->robot; }

Truth World::truth() const {
  const Impl& w = *impl_;
  Truth t;
  t.seed = w.seed;
  t.world = w.config.name;
  t.now = w.now;
  t.collisions = w.collisions.collisions();
  t.resets = w.resets;
  const SceneState scene = w.scene();
  t.X_map_base = scene.X_map_base;
  t.X_map_thermal = w.sensors.thermal().X_map_thermal(scene);
  t.q = scene.q;
  for (const WorldPart* part : w.parts) part->tell(t);
  t.starts = w.starts;
  t.kidnaps = w.disturbances.kidnaps();
  t.people = scene.people;
  t.fell = w.fell;
  t.arena = w.arena;
  if (const auto& moved = w.disturbances.moved())
    t.arena.boxes[moved->box].X_map_box = moved->X_map_box;
  return t;
}

}  // namespace kiln::sim
