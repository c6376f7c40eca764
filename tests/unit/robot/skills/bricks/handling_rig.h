#pragma once

#include "robot/planning/storage/storage_room.h"
#include "robot/skills/bricks/pick_brick.h"
#include "robot/skills/bricks/place_brick.h"
#include "robot/skills/move_arm.h"
#include "tests/unit/robot/sim/brick_rig.h"

namespace kiln {

/// The arm of the simulator's physics behind the interface that the robot sees.
class SimulatedArm final : public Arm {
 public:
  explicit SimulatedArm(sim::BrickRig& rig) : rig_(rig) {}
  [[nodiscard]] std::optional<ArmState> state() const override { return state_; }
  Result<void> servo(const ArmServo& target) override {
    return told(rig_.arm->servo(rig_.now, target.q, target.qd));
  }
  Result<void> releaseProtectiveStop() override {
    rig_.arm->releaseProtectiveStop();
    return {};
  }
  Result<void> setPayload(const ArmPayload& payload) override {
    payloads.push_back(payload);
    return told(rig_.arm->setPayload(payload));
  }
  Result<void> zeroForceSensor() override {
    rig_.arm->zeroForceSensor();
    return {};
  }
  void report() { state_ = rig_.arm->report(rig_.now, *rig_.physics); }
  std::vector<ArmPayload> payloads;

 private:
  static Result<void> told(const std::string& refusal) {
    if (refusal.empty()) return {};
    return makeError(ErrorCode::Refused, "{}", refusal);
  }
  sim::BrickRig& rig_;
  std::optional<ArmState> state_;
};

class SimulatedGripper final : public Gripper {
 public:
  explicit SimulatedGripper(sim::BrickRig& rig) : rig_(rig) {}
  [[nodiscard]] std::optional<GripperState> state() const override { return state_; }
  Result<void> write(const MagnetMask& on) override {
    rig_.gripper->write(on);
    return {};
  }
  void report() {
    const sim::GripState& grip = rig_.bricks().grip();
    state_ = rig_.gripper->report(rig_.now, grip.held || grip.touched);
  }

 private:
  sim::BrickRig& rig_;
  std::optional<GripperState> state_;
};

/// Mario's arm, controller and skills on the simulator's physics of the lab's world: real bricks,
/// its force noise, offsets and plates off their middle. Bricks lie where the test puts them.
struct HandlingRig {
  explicit HandlingRig(std::uint64_t seed = 1, sim::WorldConfig config = lab())
      : rig(config, seed) {
    run(1.0);
  }
  /// As its file says; the pile's place is the test's business.
  static sim::WorldConfig lab() {
    sim::WorldConfig config = *sim::WorldConfig::load(*resourcePath("worlds/wall_lab.yaml"));
    config.wall.site_m = config.wall.site_deg = 0.0;
    return config;
  }

  void step() {
    if (steps % 2 == 0) {
      arm.report();
      gripper.report();
      controller.tick(rig.now);
    }
    ++steps;
    rig.step();
  }
  void run(double seconds) {
    for (const Stamp end = rig.now + fromSeconds(seconds); rig.now < end;) step();
  }
  /// Polls at 50 Hz until the skill ends. @param until  looked at before each poll; true ends it.
  template <class Skill>
  SkillStatus work(Skill& skill, double limit_s, const std::function<bool()>& until = {}) {
    SkillStatus status = skill.poll(rig.now);
    for (const Stamp end = rig.now + fromSeconds(limit_s); rig.now < end;) {
      if (status.phase != SkillPhase::Running || (until && until())) break;
      for (int i = 0; i < 5; ++i) step();
      status = skill.poll(rig.now);
    }
    return status;
  }

  [[nodiscard]] Eigen::Isometry3d X_base_brick(std::size_t brick) {
    return rig.physics->X_map_base().inverse() * rig.bricks().state(brick).X_map_brick;
  }
  void lay(std::size_t brick, const Eigen::Isometry3d& X_base_brick) {
    rig.bricks().place(brick, rig.physics->X_map_base() * X_base_brick);
  }
  /// The brick's own name and where it truly lies: a perception without errors.
  [[nodiscard]] KnownBrick known(std::size_t brick) {
    const sim::TrueBrick& truth = rig.arena.wall.bricks[brick];
    return {truth.name, truth.kind, X_base_brick(brick)};
  }
  /// All other bricks, and the storage.
  [[nodiscard]] std::vector<OrientedBox> around(std::size_t but) {
    std::vector<KnownBrick> bricks;
    for (std::size_t i = 0; i < rig.bricks().size(); ++i)
      if (i != but) bricks.push_back(known(i));
    std::vector<OrientedBox> boxes = boxesOf(bricks);
    const StorageRoom room{rig.robot.storage, rig.robot.body, {}};
    for (OrientedBox& box : storageBoxes(room, StoragePosture(room.rows.size(), 0.0), {}))
      boxes.push_back(std::move(box));
    return boxes;
  }
  /// n-th brick of that kind. @pre there is one
  [[nodiscard]] std::size_t nth(BrickKind kind, int n) const {
    for (std::size_t i = rig.first(kind); i < rig.arena.wall.bricks.size(); ++i)
      if (rig.arena.wall.bricks[i].kind == kind && n-- == 0) return i;
    return rig.first(kind);
  }
  [[nodiscard]] std::string collided() const {
    std::string out;
    for (const auto& c : rig.collisions.collisions())
      out += fmt::format("{} and {}, {:.0f} N; ", c.a, c.b, c.force_n);
    return out;
  }

  sim::BrickRig rig;
  SimulatedArm arm{rig};
  SimulatedGripper gripper{rig};
  StopLatch stop;
  ArenaMap arena;  ///< flat and empty: all that stands around is told with each move
  ArmController controller{{}, rig.robot, arm, stop};
  MoveArm motion{{}, rig.robot, arena, controller, arm, [] { return Pose2{}; }};
  HandlingParts parts{rig.robot, motion, controller, arm, gripper};
  int steps = 0;
};

/// Lies flat there, in base.
inline Eigen::Isometry3d lying(double x_m, double y_m, int layer, double yaw_rad) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() << x_m, y_m, (layer + 0.5) * kBrickSide_m;
  X.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return X;
}

}  // namespace kiln
