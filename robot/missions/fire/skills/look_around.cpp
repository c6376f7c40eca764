#include "robot/missions/fire/skills/look_around.h"

#include <algorithm>
#include <cmath>

namespace kiln {

bool LookAround::choosePath(const Eigen::Isometry3d& X_map_base, const Eigen::Vector3d& p_place_map,
                            const Eigen::Vector3d& normal_map) {
  const Eigen::Isometry3d X_base_map = X_map_base.inverse();
  const Eigen::Isometry3d X_thermal_flange = robot_.X_flange_thermal.pose().inverse();
  for (double scale = 1.0; scale >= config_.smallest_scale - 1e-9; scale -= 0.2)
    for (const int k : {0, 1, -1, 2, -2}) {
      const auto cameras =
          searchRectangle(p_place_map, normal_map, config_.standoff_m + k * config_.standoff_step_m,
                          scale * config_.half_width_m, scale * config_.half_height_m);
      path_.clear();
      for (const Eigen::Isometry3d& X_map_thermal : cameras)
        path_.push_back(X_base_map * X_map_thermal * X_thermal_flange);
      const auto reachable = [this](const Eigen::Isometry3d& X) {
        return arm_.check(X).has_value();
      };
      if (std::all_of(path_.begin(), path_.end(), reachable)) return true;
    }
  return false;
}

void LookAround::start(const Eigen::Isometry3d& X_map_base, const Eigen::Vector3d& p_place_map,
                       const Eigen::Vector3d& normal_map, Stamp now) {
  if (!choosePath(X_map_base, p_place_map, normal_map)) {
    stage_ = Stage::Failed;
    ended_ = {SkillPhase::Failed, 0.0, "no search motion before the place can be reached",
              "unreachable"};
    return;
  }
  stage_ = Stage::Approach;
  corner_ = 0;
  arm_.startPose(path_.front(), now);
}

SkillStatus LookAround::poll(Stamp now) {
  if (stage_ == Stage::Idle) return {};
  if (stage_ == Stage::Done || stage_ == Stage::Failed) return ended_;
  SkillStatus arm = arm_.poll(now);
  if (arm.phase == SkillPhase::Failed) return onArmFailed(std::move(arm), now);
  if (arm.phase == SkillPhase::Done) return onArmDone(std::move(arm), now);
  const double corners = static_cast<double>(path_.size());
  if (stage_ == Stage::Approach)
    return {SkillPhase::Running, 0.0, "moving to the first corner", {}};
  const double share = stage_ == Stage::Sweep
                           ? arm.progress
                           : (static_cast<double>(corner_) + arm.progress) / corners;
  return {SkillPhase::Running, share, "sweeping", {}};
}

SkillStatus LookAround::onArmFailed(SkillStatus arm, Stamp now) {
  const bool geometric = arm.failure_code == "unreachable" || arm.failure_code == "in_collision";
  if (stage_ == Stage::Sweep && geometric) {
    stage_ = Stage::Corners;
    corner_ = 1;
    arm_.startPose(path_[corner_], now);
    return {SkillPhase::Running, 0.0, "no straight line; going from corner to corner", {}};
  }
  stage_ = Stage::Failed;
  ended_ = std::move(arm);
  return ended_;
}

SkillStatus LookAround::onArmDone(SkillStatus arm, Stamp now) {
  if (stage_ == Stage::Approach) {
    stage_ = Stage::Sweep;
    arm_.startCartesian({path_.begin() + 1, path_.end()}, true, now);
    return {SkillPhase::Running, 0.0, "sweeping", {}};
  }
  if (stage_ == Stage::Corners && ++corner_ < path_.size()) {
    arm_.startPose(path_[corner_], now);
    return {SkillPhase::Running, 0.0, "sweeping", {}};
  }
  stage_ = Stage::Done;
  ended_ = std::move(arm);
  return ended_;
}

void LookAround::cancel() {
  if (stage_ == Stage::Approach || sweeping()) arm_.cancel();
  stage_ = Stage::Idle;
}

}  // namespace kiln
