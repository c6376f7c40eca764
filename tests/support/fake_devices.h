#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "common/core/clock.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/hal/arm.h"
#include "robot/hal/drive_base.h"
#include "robot/hal/pumps.h"

namespace kiln {

/// Devices for tests: first-order plants under a clock that the test moves, with the fail-safes of
/// the real ones. Call advance() each test step (e.g. each control tick); state() is what was last
/// measured. Thread-safe.
class FakeArm final : public Arm {
 public:
  FakeArm(const Clock& clock, const RobotGeometry& robot, const Vector6d& q_start);
  [[nodiscard]] std::optional<ArmState> state() const override;
  Result<void> servo(const ArmServo& target) override;
  Result<void> releaseProtectiveStop() override;
  Result<void> setPayload(const ArmPayload& payload) override;
  Result<void> zeroForceSensor() override;
  void advance();

  void setForce(const Eigen::Vector3d& force_n);  ///< what the sensor shows, arm_base axes
  void setSafety(ArmSafetyMode safety);
  void setPowered(bool powered);
  void freezeState(bool frozen);  ///< the last state keeps its stamp: a dead link
  void setQ(const Vector6d& q);   ///< joints pushed by hand
  void jam(bool jammed);          ///< joints stand still whatever is commanded
  [[nodiscard]] Vector6d trueQ() const;
  [[nodiscard]] std::vector<ArmServo> sent() const;  ///< every target that reached the device
  [[nodiscard]] int releases() const;
  [[nodiscard]] std::vector<ArmPayload> payloads() const;  ///< that it was told
  [[nodiscard]] int zeroings() const;

 private:
  const Clock& clock_;
  UrKinematics limits_;
  mutable std::mutex mutex_;
  ArmState state_;
  std::optional<ArmServo> target_;
  Stamp target_stamp_, last_;
  std::optional<ArmState> frozen_;  ///< what state() repeats
  bool jammed_ = false;
  int releases_ = 0, zeroings_ = 0;
  Eigen::Vector3d zero_n_ = Eigen::Vector3d::Zero();
  std::vector<ArmPayload> payloads_;
  std::vector<ArmServo> sent_;
};

/// Wheels that steer at the rated speed and drive with a first-order lag; knows the true pose of
/// the base.
class FakeBase final : public DriveBase {
 public:
  FakeBase(const Clock& clock, const RobotGeometry& robot);
  [[nodiscard]] std::optional<BaseState> state() const override;
  Result<void> write(const WheelCommands& command) override;
  void advance();

  void freezeState(bool frozen);
  void jam(bool jammed);  ///< wheels do not turn
  void setSag(
      double speed_mps);  ///< what a load takes from each wheel's speed; negative: backwards
  void setSteer(const std::array<double, 4>& steer_rad);
  void setTruePose(const Pose2& X_map_base);
  [[nodiscard]] Pose2 truePose() const;  ///< X_map_base
  [[nodiscard]] std::vector<WheelCommands> sent() const;

 private:
  const Clock& clock_;
  RobotGeometry robot_;
  mutable std::mutex mutex_;
  BaseState state_;
  WheelCommands command_{};
  Pose2 X_map_base_;
  Stamp command_stamp_, last_;
  bool frozen_ = false, jammed_ = false, commanded_ = false;
  double sag_mps_ = 0.0;
  std::vector<WheelCommands> sent_;
};

/// Pumps that draw current when they run and are cut without a heartbeat.
class FakePumps final : public Pumps {
 public:
  explicit FakePumps(const Clock& clock);
  [[nodiscard]] std::optional<PumpsState> state() const override;
  Result<void> write(const std::array<double, 2>& duty) override;
  void advance();

  void setDry(int pump, bool dry);  ///< draws no current
  void freezeState(bool frozen);
  [[nodiscard]] int writes() const;
  [[nodiscard]] double trueLitres() const;  ///< 1.6 l/min a pump, linear spin-up of 0.4 s

 private:
  const Clock& clock_;
  mutable std::mutex mutex_;
  PumpsState state_;
  std::array<double, 2> duty_{}, speed_{};
  std::array<bool, 2> dry_{};
  Stamp write_stamp_, last_;
  bool frozen_ = false;
  int writes_ = 0;
  double litres_ = 0.0;
};

}  // namespace kiln
