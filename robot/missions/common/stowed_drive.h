#pragma once

#include <vector>

#include "robot/missions/common/mission_parts.h"

namespace kiln {

/// Drives only with the arm in its drive pose: stows it first, then starts the base, with a run-up
/// where a wheel stands against the edge of the approach. The base never moves with an extended
/// arm. Confined to the mission thread.
class StowedDrive {
 public:
  /// @param parts  outlive it.
  StowedDrive(const MissionParts& parts, double tolerance_rad);

  void start(std::vector<Pose2> waypoints_map, Stamp now);
  /// Failed with the arm's or the base's reason; `armFailed()` tells which.
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();
  [[nodiscard]] bool armFailed() const { return arm_failed_; }
  [[nodiscard]] bool stowed() const;  ///< measured joints are at the drive pose

 private:
  enum class Stage { Idle, Stowing, RunUp, Driving, Ended };
  [[nodiscard]] SkillStatus pollArm(Stamp now);
  [[nodiscard]] SkillStatus begin(Stage stage, std::vector<Pose2> waypoints_map, const char* text,
                                  Stamp now);
  [[nodiscard]] SkillStatus end(SkillStatus status);

  MissionParts parts_;
  Vector6d q_drive_;
  double tolerance_rad_;
  Stage stage_ = Stage::Idle;
  bool arm_moves_ = false;
  bool arm_failed_ = false;
  std::vector<Pose2> waypoints_;
  SkillStatus ended_;
};

}  // namespace kiln
