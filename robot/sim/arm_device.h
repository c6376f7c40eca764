#pragma once

#include <optional>
#include <string>

#include "common/core/stamp.h"
#include "common/model/sensor.h"
#include "robot/sim/physics.h"
#include "robot/sim/random.h"

namespace kiln::sim {

/// The UR10e's own controller: follows servo targets, holds by itself when they stop, and goes into
/// a protective stop on contact force or on a target beyond its limits. Only
/// releaseProtectiveStop() ends that. Thread-compatible.
class ArmDevice {
 public:
  ArmDevice(const ArmDeviceConfig& config, const RobotGeometry& robot, std::uint64_t seed);

  /// @param sent  when the target was sent, by the sender's clock. Targets that waited in a queue
  ///              while this machine was busy come in a bunch; their pace is that of the sending.
  /// @return empty, or why the target was refused.
  std::string servo(Stamp now, const Vector6d& q, const Vector6d& qd,
                    std::optional<Stamp> sent = std::nullopt);
  void releaseProtectiveStop();
  void protectiveStop();
  /// The robot was carried to its start: hold there, no stop latched. Targets that were under way
  /// then belong to another posture; for ArmDeviceConfig::carry_grace_s those that do not fit are
  /// dropped and not taken for a jump.
  void reset(Stamp now, const Vector6d& q);
  /// Before each physics step: torques for this instant.
  void control(Stamp now, double step_s, Physics& physics);
  /// After each physics step: external forces on the arm.
  void sense(double step_s, const Physics& physics);
  /// As reported to the robot: with noise.
  [[nodiscard]] ArmState report(Stamp now, const Physics& physics);

 private:
  [[nodiscard]] std::string refusal(double since_s, const Vector6d& q, const Vector6d& qd) const;
  void advanceReference(Stamp now, double step_s);

  ArmDeviceConfig config_;
  RobotGeometry robot_;
  Random noise_;
  Vector6d q_ref_ = Vector6d::Zero(), qd_ref_ = Vector6d::Zero();
  Vector6d target_q_ = Vector6d::Zero(), target_qd_ = Vector6d::Zero();
  Stamp target_time_;
  std::optional<Stamp> target_sent_, carried_;
  bool following_ = false;
  bool stopped_ = false;
  Vector6d wrench_ = Vector6d::Zero();  ///< filtered, true, in arm_base orientation at the tool
};

}  // namespace kiln::sim
