#pragma once

#include <optional>
#include <string>

#include "common/config/config_archive.h"
#include "robot/hal/gripper.h"
#include "robot/skills/bricks/held_brick.h"

namespace kiln {

/// A brick that is not held any more. For the database of bricks: it lies somewhere below.
struct BrickDrop {
  std::string name;
  Stamp noticed;
  std::string why;  ///< "the contact switch has opened"
  /// Where it hung last, X_base_brick.
  Eigen::Isometry3d X_base_brick = Eigen::Isometry3d::Identity();
};

/// Notices within 0.3 s that a held brick is gone, from 50 Hz of states: the contact switch opens
/// while the magnets should hold, or the force sensor feels the weight missing that the arm was
/// told of (paper, "Multi Purpose End-effector": the switch tells whether a brick is held). Confined
/// to the mission thread.
class HeldBrickWatch {
 public:
  struct Config {
    double open_s = 0.06;        ///< the switch is open for so long
    double missing_share = 0.6;  ///< of the weight, not felt
    double missing_s = 0.14;     ///< for so long
    double force_filter_s = 0.03;
    double max_age_s = 0.25;  ///< an older state of the gripper says nothing
    void visit(ConfigArchive& a);
  };
  HeldBrickWatch(Config config, const RobotGeometry& robot) : config_(config), robot_(robot) {}
  /// From now on this brick is held, the arm was told of it and its force sensor zeroed without it.
  void begin(const HeldBrick& brick, Stamp now);
  void end() { brick_.reset(); }
  /// Something else carries it, too: its weight says nothing. The switch alone is looked at.
  void setSupported(bool supported);
  /// Judges the newest states. The same drop is told once; nothing is watched then.
  [[nodiscard]] std::optional<BrickDrop> poll(const std::optional<GripperState>& gripper,
                                              const std::optional<ArmState>& arm, Stamp now);
  /// The gripper's state is too old to tell: "the gripper has not reported for 0.4 s"; else empty.
  [[nodiscard]] std::string blind(const std::optional<GripperState>& gripper, Stamp now) const;
  [[nodiscard]] const std::optional<HeldBrick>& brick() const { return brick_; }

 private:
  Config config_;
  const RobotGeometry& robot_;
  std::optional<HeldBrick> brick_;
  bool supported_ = false;
  double up_n_ = 0.0;  ///< low-passed
  Stamp last_;
  std::optional<Stamp> open_since_, missing_since_;
};

/// Force on the tool along the base's Z, N: what holds it up counts positive.
[[nodiscard]] double upForce(const RobotGeometry& robot, const ArmState& arm);

}  // namespace kiln
