#pragma once

#include <span>
#include <string>

#include "common/config/config_archive.h"
#include "robot/planning/arm_motion/swept_volume.h"
#include "robot/skills/surroundings.h"

namespace kiln {

/// Before a scripted arm motion: does anything in the live cloud stand where the arm would pass?
struct ArmWatchConfig {
  bool enabled = true;
  double blind_s = 2.0;  ///< an older cloud says nothing: the motion is refused
  double reach_m = 2.2;  ///< from the arm's mount; points farther away are not looked at
  SweptVolumeConfig swept;
  void visit(ConfigArchive& a);
};

/// @param known  in base: what the motion was planned around, and what the live cloud shows of it.
/// @return why the arm must not move along `paths`: "something stands in the way of the forearm,
/// 0.42 m above the deck ..."; empty when the way is free.
[[nodiscard]] std::string whatHindersArm(const ArmWatchConfig& config, const ArmCollision& arm,
                                         const Eigen::Vector3d& p_base_armbase,
                                         std::span<const JointPath> paths,
                                         std::span<const OrientedBox> known,
                                         const Surroundings& surroundings, Stamp now);

}  // namespace kiln
