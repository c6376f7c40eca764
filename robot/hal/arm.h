#pragma once

#include <optional>

#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln {

/// Position target for the arm's servo loop (servoj on a UR). The device itself refuses a target
/// that would need more than its joint limits and enters a protective stop.
struct ArmServo {
  Vector6d q = Vector6d::Zero();   ///< rad
  Vector6d qd = Vector6d::Zero();  ///< rad/s feed-forward
};

/// What the arm carries, as its controller is told.
struct ArmPayload {
  double mass_kg = 0.0;
  Eigen::Vector3d p_flange_com = Eigen::Vector3d::Zero();  ///< centre of mass
};

/// A six-joint arm with a position servo. Device fail-safe: without a servo target for 200 ms it
/// decelerates and holds. Thread-safe.
class Arm {
 public:
  virtual ~Arm() = default;
  [[nodiscard]] virtual std::optional<ArmState> state() const = 0;
  /// @pre all finite. Called at the servo rate (125 Hz; 500 Hz for a UR10e).
  virtual Result<void> servo(const ArmServo& target) = 0;
  /// Only on the operator's explicit word: automatic release of protective stops is prohibited by
  /// the vendor.
  virtual Result<void> releaseProtectiveStop() = 0;
  /// Its weight and inertia are taken off the reported force and off the one that ends in a
  /// protective stop. Switched on, a controller has been told nothing.
  virtual Result<void> setPayload(const ArmPayload& payload) = 0;
  /// Takes the force that is felt now as zero (what the sensor is off, as it drifts). @pre at rest,
  /// without contact.
  virtual Result<void> zeroForceSensor() = 0;
};

}  // namespace kiln
