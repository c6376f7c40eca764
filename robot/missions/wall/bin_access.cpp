#include "robot/missions/wall/bin_access.h"

#include <algorithm>
#include <cmath>

namespace kiln {

void BinAccess::start(WallContext& context, const StorageStep& step, const HeldBrick& brick) {
  context_ = &context;
  step_ = step;
  brick_ = brick;
  postures_ = candidates();
  tried_ = 0;
  stage_ = Stage::Begun;
}

bool BinAccess::tryNext() {
  stage_ = Stage::Begun;
  return ++tried_ < postures_.size();
}

SkillStatus BinAccess::poll(Stamp now) {
  MoveStorage& travel = context_->hands->travel;
  if (stage_ == Stage::Travelling) return travel.poll(now);
  if (stage_ == Stage::Begun) stage_ = exit_.start(*context_, now) ? Stage::Leaving : Stage::Asking;
  if (stage_ == Stage::Leaving) {
    SkillStatus out = exit_.poll(now);
    if (out.phase == SkillPhase::Failed) out.text = "not out of the storage: " + out.text;
    if (out.phase == SkillPhase::Done) stage_ = Stage::Asking;
    if (out.phase != SkillPhase::Done) return out;
  }
  if (const auto reached = check(posture()); !reached) {
    if (!tryNext())
      return {SkillPhase::Failed, 0.0,
              "its bin is out of the arm's reach: " + reached.error().message, "unreachable"};
    return {SkillPhase::Running, 0.0, "where does the arm reach its bin?", ""};
  }
  stage_ = Stage::Travelling;
  travel.start(posture(), now);
  return {SkillPhase::Running, 0.0, "the storage travels", ""};
}

std::vector<StoragePosture> BinAccess::candidates() const {
  constexpr double kStep_m = 0.05;
  const std::size_t moved = step_.seat.compartment;
  const CompartmentConfig& row = context_->parts.robot.storage[moved];
  std::vector<StoragePosture> out{step_.posture};
  for (double at = row.travel_min_m; at <= row.travel_max_m; at += kStep_m) {
    out.push_back(step_.posture);
    out.back()[moved] = at;
  }
  const auto way = [&](const StoragePosture& p) {
    return std::abs(p[moved] - step_.posture[moved]);
  };
  std::stable_sort(out.begin(), out.end(),
                   [&](const auto& a, const auto& b) { return way(a) < way(b); });
  return out;
}

/// By the way in: it is the way out as well. Error: what hinders the arm.
Result<void> BinAccess::check(const StoragePosture& posture) const {
  const WallContext& c = *context_;
  const MissionParts& parts = c.parts;
  std::vector<Eigen::Isometry3d> way = c.seatWay(step_, posture);
  way.push_back(c.X_base_seat(step_, posture, 2.0 * c.config.storage.front_m));
  const Eigen::Isometry3d X_brick_flange =
      brick_.X_tool_brick.inverse() * parts.robot.X_flange_tool.pose().inverse();
  Result<void> out;
  for (const double turn : {0.0, M_PI}) {
    const auto flangeFor = [&](const Eigen::Isometry3d& X_base_brick) -> Eigen::Isometry3d {
      return X_base_brick * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * X_brick_flange;
    };
    ArmMoveTerms terms;
    terms.scene.boxes = c.storageAt(posture);
    terms.carried = brick_.inFlange(parts.robot);
    terms.clearance_m = c.config.loading.store.handling.line_clearance_m;
    // Head and brick may touch the storage there; the arm's links may not.
    terms.ahead = LineAhead{{}, {}, *terms.clearance_m};
    for (const OrientedBox& box : terms.scene.boxes) terms.ahead->touchable.push_back(box.name);
    for (std::size_t i = 1; i < way.size(); ++i)
      terms.ahead->X_base_flange.push_back(flangeFor(way[i]));
    parts.arm.setTerms(std::move(terms));
    const auto q = parts.arm.check(flangeFor(way.front()));
    if (q) return {};
    out = tl::make_unexpected(q.error());
  }
  return out;
}

}  // namespace kiln
