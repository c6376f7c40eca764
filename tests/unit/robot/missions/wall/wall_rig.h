#pragma once

#include <algorithm>
#include <functional>
#include <memory>

#include "common/config/resources.h"
#include "common/core/manual_executor.h"
#include "robot/missions/wall/wall_machine.h"
#include "robot/planning/arm_motion/ur_inverse.h"
#include "tests/unit/robot/missions/fire/fake_motion.h"
#include "tests/unit/robot/skills/bricks/fake_handling.h"

namespace kiln {

/// Compartments that are where they were told to be, one state later.
class PromptStorage final : public Storage {
 public:
  explicit PromptStorage(const Clock& clock) : clock_(clock) {}
  [[nodiscard]] std::optional<StorageState> state() const override {
    StorageState out;
    out.stamp = clock_.now();
    out.compartments = {{position_m, position_m, 0.0, false, false}};
    return out;
  }
  Result<void> write(std::span<const double> targets_m) override {
    position_m = targets_m.front();
    ++writes;
    return {};
  }
  double position_m = 0.0;
  int writes = 0;

 private:
  const Clock& clock_;
};

/// The wall mission's states on Mario in the lab, with motions that end as they should (whatever is
/// lowered or led sideways meets something) or as the test says.
struct WallRig : FakeHandling {
  /// @param bricks  of the plan that are in the storage, the marker found, the base before the wall;
  /// 0: nothing is known yet.
  explicit WallRig(std::size_t bricks) {
    motions.rule = [this](const ArmMoveTerms& terms) {
      const double n = terms.guard_force_n.value_or(1e3);
      return n <= context->config.building.set.support_n ||
                     n == context->config.building.take_out.touch_n
                 ? "contact"
                 : "";
    };
    arena = *loadResource<ArenaMap>("config/arena_wall_lab.yaml");
    WallConfig config;
    const WallSiteMap site = *loadWallSite(arena);
    const MissionParts lent{clock,
                            executor,
                            arena,
                            robot,
                            belief,
                            base,
                            motions,
                            arm,
                            pumps,
                            [this] { return base.pose(); },
                            [] { return std::deque<ScanWindow::Entry>(); },
                            [](Stamp) { return std::nullopt; },
                            [](Stamp) { return std::nullopt; },
                            [](const ThermalImagePtr&) {},
                            [](const MissionDetail&) {},
                            &controller,
                            &gripper,
                            &storage};
    config.loading.bricks = 11;
    context = std::make_unique<WallContext>(lent, config, site, *planWall(config, robot));
    if (bricks > 0) {
      context->belief.pile = FoundFrame{site.pile.pose()};
      context->belief.wall = FoundFrame{site.marker.pose()};
      context->belief.stored = bricks;
      base.carryTo(context->buildingPose());
    }
    machine = makeWallMachine(*context, "test-uuid");
    belief.startClock(clock.now());
    machine->start("", clock.now());
  }

  void force(const std::string& to) {
    ChangeState change;
    change.to = to;
    change.step = machine->status(clock.now()).step;
    change.from = state();
    const auto forced = machine->changeState(change, "test", clock.now());
    EXPECT_EQ(forced.outcome, ChangeStateOutcome::Ok) << forced.reason;
  }
  [[nodiscard]] std::string state() { return machine->status(clock.now()).state; }
  /// @return whether it came there within `limit_s`.
  bool runTo(const std::function<bool()>& there, double limit_s = 200.0) {
    for (const Stamp end = clock.now() + fromSeconds(limit_s); clock.now() < end;) {
      if (there()) return true;
      for (int i = 0; i < 5; ++i) step();
      executor.runUntil(clock.now());
      gripper.contact = hangs && (gripper.on.any() || sticks);
      machine->step(clock.now());
    }
    return there();
  }
  bool runToState(const std::string& wanted, double limit_s = 200.0) {
    return runTo([&] { return state() == wanted; }, limit_s);
  }
  [[nodiscard]] std::string why() { return machine->status(clock.now()).history.back().note; }
  /// The arm holds its face flush on the brick of this step, its bin standing as planned.
  void reachInto(const StorageStep& step) {
    storage.position_m = step.posture.front();
    const auto reached = [&](bool half_turn) {
      return motions.jump(context->X_base_seat(step, step.posture) *
                          X_brick_face({0, 0}, half_turn) * robot.X_flange_tool.pose().inverse());
    };
    ASSERT_TRUE(reached(false) || reached(true));
    for (int i = 0; i < 5; ++i) this->step();
  }

  /// The arm jumps to where it is told.
  struct Motions final : ToldMotion {
    explicit Motions(WallRig& of) : rig(of) {}
    bool jump(const Eigen::Isometry3d& X_base_flange) {
      const Vector6d here = rig.arm.trueQ();
      auto all = inverseSolutions(rig.robot.arm,
                                  rig.robot.X_base_armbase.pose().inverse() * X_base_flange, here);
      if (all.empty()) return false;
      for (Vector6d& q : all) q = nearestTurn(rig.robot.arm, q, here);
      rig.arm.setQ(*std::min_element(all.begin(), all.end(), [&](const auto& x, const auto& y) {
        return (x - here).norm() < (y - here).norm();
      }));
      return true;
    }
    void startJoints(const Vector6d& q, Stamp now) override {
      ToldMotion::startJoints(q, now);
      rig.arm.setQ(q);
    }
    void startPose(const Eigen::Isometry3d& X, Stamp now) override {
      ToldMotion::startPose(X, now);
      if (ending != "never") (void)jump(X);
    }
    void startCartesian(std::vector<Eigen::Isometry3d> poses, bool blend, Stamp now) override {
      const Eigen::Isometry3d last = poses.back();
      ToldMotion::startCartesian(std::move(poses), blend, now);
      if (ending != "never") (void)jump(last);
    }
    WallRig& rig;
  };

  ManualExecutor executor{clock};
  ArenaMap arena;
  RobotBelief belief;
  FakeBaseMotion base{Pose2{}};
  Motions motions{*this};
  FakePumps pumps_device{clock};
  PumpController pumps{{}, pumps_device, stop};
  PromptStorage storage{clock};
  bool hangs = true;    ///< a brick, when the magnets are on
  bool sticks = false;  ///< and when they are off
  std::unique_ptr<WallContext> context;
  std::unique_ptr<Machine> machine;
};

}  // namespace kiln
