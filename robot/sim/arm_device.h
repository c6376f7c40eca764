#pragma once

#include <optional>
#include <string>

#include "common/core/stamp.h"
#include "common/model/sensor.h"
#include "robot/hal/arm.h"
#include "robot/sim/physics.h"
#include "robot/sim/random.h"

namespace kiln::sim {

/// The UR10e's own controller: follows servo targets, holds by itself when they stop, and goes into
/// a protective stop on contact force or on a target beyond its limits. Only
/// releaseProtectiveStop() ends that. Its force sensor sits at the tool and feels the weight and
/// the inertia of what is fixed there too; what the controller was told of the payload is taken off
/// (gravity along its own Z, accelerations by its joints), and what zeroing has found.
/// Thread-compatible.
class ArmDevice {
 public:
  ArmDevice(const ArmDeviceConfig& config, const RobotGeometry& robot, const TrueRobot& truth,
            std::uint64_t seed);

  /// @param sent  when the target was sent, by the sender's clock. Targets that waited in a queue
  ///              while this machine was busy come in a bunch; their pace is that of the sending.
  /// @return empty, or why the target was refused.
  std::string servo(Stamp now, const Vector6d& q, const Vector6d& qd,
                    std::optional<Stamp> sent = std::nullopt);
  /// @return empty, or why it was refused.
  std::string setPayload(const ArmPayload& payload);
  void zeroForceSensor();
  void releaseProtectiveStop();
  void protectiveStop();
  /// In a reduced zone less force ends in a protective stop.
  void setReduced(bool reduced) { reduced_ = reduced; }
  /// Without power the brakes hold and targets are refused.
  void setPowered(bool powered);
  /// The robot was carried to its start: hold there, no stop latched. Targets that were under way
  /// then belong to another posture; for ArmDeviceConfig::carry_grace_s those that do not fit are
  /// dropped and not taken for a jump.
  void reset(Stamp now, const Vector6d& q);
  /// Before each physics step: torques for this instant.
  void control(Stamp now, double step_s, Physics& physics);
  /// After each physics step: contacts, and the load at the tool.
  void sense(Stamp now, double step_s, const Physics& physics);
  /// As reported to the robot: with noise.
  [[nodiscard]] ArmState report(Stamp now, const Physics& physics);

 private:
  [[nodiscard]] std::string refusal(double since_s, const Vector6d& q, const Vector6d& qd) const;
  void advanceReference(Stamp now, double step_s);
  void carryPayload(Physics& physics) const;
  /// Contacts of the arm and load of the head less what was told, at the tool, arm_base axes.
  [[nodiscard]] Vector6d contactWrench(const Physics& physics) const;
  [[nodiscard]] Vector6d uncompensatedLoad(double step_s, const Physics& physics);
  /// Offset and drift of the sensor, flange axes, N.
  [[nodiscard]] Eigen::Vector3d sensorError(Stamp now) const;

  ArmDeviceConfig config_;
  RobotGeometry robot_;
  Random noise_;
  Vector6d q_ref_ = Vector6d::Zero(), qd_ref_ = Vector6d::Zero();
  Vector6d target_q_ = Vector6d::Zero(), target_qd_ = Vector6d::Zero();
  Stamp target_time_;
  std::optional<Stamp> target_sent_, carried_;
  bool following_ = false;
  bool stopped_ = false, reduced_ = false, powered_ = true;
  double head_kg_;
  Eigen::Vector3d p_flange_head_;
  ArmPayload payload_;  ///< as told
  /// Of the last step: the head's centre of mass in map, and the told one in arm_base, m/s.
  std::optional<Eigen::Vector3d> v_head_, p_told_, v_told_;
  Eigen::Vector3d sensor_offset_n_, drift_direction_;         ///< flange axes
  Eigen::Vector3d sensor_error_n_ = Eigen::Vector3d::Zero();  ///< of now, flange axes
  Vector6d wrench_ = Vector6d::Zero();  ///< filtered, compensated, in arm_base axes at the tool
  Eigen::Matrix3d R_armbase_flange_ = Eigen::Matrix3d::Identity();
  Vector6d zero_flange_ = Vector6d::Zero();  ///< what zeroing takes off
};

}  // namespace kiln::sim
