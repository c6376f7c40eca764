#pragma once

#include <vector>

#include "common/robot_model/robot_geometry.h"
#include "robot/missions/fire/skills/search_rectangle.h"
#include "robot/skills/motion.h"

namespace kiln {

/// Moves the thermal camera along the search rectangle before a place. Takes the nearest standoff
/// and the largest rectangle that the arm can reach; goes from corner to corner where straight
/// lines are not possible. Confined to the mission thread.
class LookAround {
 public:
  LookAround(SearchConfig config, const RobotGeometry& robot, ArmMotion& arm)
      : config_(config), robot_(robot), arm_(arm) {}

  /// @param X_map_base  robot pose, which must not change until the skill has ended.
  void start(const Eigen::Isometry3d& X_map_base, const Eigen::Vector3d& p_place_map,
             const Eigen::Vector3d& normal_map, Stamp now);
  /// Failed: no rectangle can be reached ("unreachable"), or the arm's own reason ("contact", ...).
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();
  /// The arm has arrived at the first corner. Images count on the way there too: a source seen from
  /// anywhere is seen (HeatWatch).
  [[nodiscard]] bool sweeping() const { return stage_ == Stage::Sweep || stage_ == Stage::Corners; }

 private:
  enum class Stage { Idle, Approach, Sweep, Corners, Done, Failed };
  [[nodiscard]] bool choosePath(const Eigen::Isometry3d& X_map_base,
                                const Eigen::Vector3d& p_place_map,
                                const Eigen::Vector3d& normal_map);
  [[nodiscard]] SkillStatus onArmFailed(SkillStatus arm, Stamp now);
  [[nodiscard]] SkillStatus onArmDone(SkillStatus arm, Stamp now);

  SearchConfig config_;
  const RobotGeometry& robot_;
  ArmMotion& arm_;
  Stage stage_ = Stage::Idle;
  std::vector<Eigen::Isometry3d> path_;  ///< X_base_flange
  std::size_t corner_ = 0;
  SkillStatus ended_;
};

}  // namespace kiln
