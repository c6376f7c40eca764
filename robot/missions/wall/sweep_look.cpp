#include "robot/missions/wall/sweep_look.h"

#include <utility>

#include <fmt/format.h>

#include "robot/scene/obstacles.h"

namespace kiln {
namespace {

/// One view of whatever stands ahead.
Result<ViewPlan> firstLookAlone(const ViewPlanner& planner, const ViewPlanner::Reach& reach) {
  auto motion = planner.firstLook(reach);
  if (!motion) return tl::make_unexpected(motion.error());
  ViewPlan plan;
  plan.views.push_back({{}, *motion, {}});
  return plan;
}

}  // namespace

void SweepLook::Config::visit(ConfigArchive& a) {
  a.section("views", views, "which sweeps are made");
  a.section("sweep", sweep, "one sweep of the LiDAR");
  a.field("plan_latency_s", plan_latency_s, "s", 0, 5, "modelled latency in lockstep");
}

SweepLook::SweepLook(const Config& config, const MissionParts& parts)
    : config_(config),
      parts_(parts),
      views_(parts.executor, "brick_views", config.plan_latency_s),
      lidar_(config.sweep, parts.arm, parts.scans) {}

void SweepLook::start(std::optional<ExpectedBricks> expected, std::vector<OrientedBox> on_base) {
  stage_ = Stage::Planning;
  next_ = 0;
  all_.reset();
  const auto arm = parts_.arm_device.state();
  const Vector6d q = arm ? arm->q : RobotGeometry::radians(parts_.robot.q_drive_deg);
  views_.ask([config = config_.views, &robot = parts_.robot, boxes = obstacles(parts_.arena),
              X_map_base = parts_.pose(), q, expected = std::move(expected),
              on_base = std::move(on_base)]() -> Result<ViewPlan> {
    ArmCollision world(robot);
    world.setScene(boxes, X_map_base, {on_base, {}});
    const ViewPlanner planner(config, robot);
    const ViewPlanner::Reach reach = planner.reachOf(world, q);
    return expected ? planner.plan(*expected, reach) : firstLookAlone(planner, reach);
  });
}

SkillStatus SweepLook::end(Stage stage, SkillStatus status) {
  stage_ = stage;
  ended_ = std::move(status);
  return ended_;
}

SkillStatus SweepLook::planned(Stamp now) {
  const Result<ViewPlan> plan = *views_.answer();
  if (!plan || plan->views.empty())
    return end(Stage::Failed,
               {SkillPhase::Failed, 0.0,
                plan ? "no sweep can be made: " + plan->why : plan.error().message, "no_view"});
  plan_ = *plan;
  all_ = std::make_shared<BrickSweep>();
  stage_ = Stage::Sweeping;
  lidar_.start(plan_.views.front().motion, now);
  return {SkillPhase::Running, 0.0, "sweeps", {}};
}

SkillStatus SweepLook::poll(Stamp now) {
  if (stage_ == Stage::Planning) {
    views_.tick();
    if (views_.answer()) return planned(now);
    return {SkillPhase::Running, 0.0, "chooses the views", {}};
  }
  if (stage_ != Stage::Sweeping) return ended_;
  const SkillStatus sweep = lidar_.poll(now);
  const std::size_t count = plan_.views.size();
  const std::string which = fmt::format("sweep {} of {}", next_ + 1, count);
  if (sweep.phase == SkillPhase::Failed)
    return end(Stage::Failed,
               {SkillPhase::Failed, sweep.progress, which + ": " + sweep.text, sweep.failure_code});
  if (sweep.phase == SkillPhase::Done) {
    all_->add(lidar_.cloud().sweep);
    if (++next_ == count)
      return end(Stage::Done, {SkillPhase::Done, 1.0, lidar_.cloud().text(), {}});
    lidar_.start(plan_.views[next_].motion, now);
  }
  const double progress =
      (static_cast<double>(next_) + sweep.progress) / static_cast<double>(count);
  return {SkillPhase::Running, progress, which, {}};
}

void SweepLook::cancel() {
  views_.clear();
  if (stage_ == Stage::Sweeping) lidar_.cancel();
  end(Stage::Idle, {SkillPhase::Idle, 0.0, "cancelled", {}});
}

}  // namespace kiln
