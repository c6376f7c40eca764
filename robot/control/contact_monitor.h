#pragma once

#include <Eigen/Core>

namespace kiln {

/// Contact force at the tool: measured force less its slow mean at rest (drift of the sensor, what
/// the payload is off), low-passed against the sensor's noise of 1 N rms. Thread-compatible.
class ContactMonitor {
 public:
  struct Config {
    double filter_s = 0.02;      ///< low-pass of the force
    double bias_filter_s = 1.0;  ///< slow mean, learnt only at rest and without contact
    double max_bias_n = 10.0;    ///< the mean never takes away more than this
  };
  explicit ContactMonitor(Config config) : config_(config) {}
  /// @param force_n  finite force, arm_base axes, N.
  /// @return contact force, N.
  double update(const Eigen::Vector3d& force_n, bool at_rest, double dt_s);
  /// Forgets force and mean: the next sample seeds them anew.
  void restart() { *this = ContactMonitor(config_); }
  [[nodiscard]] double force() const { return filtered_.norm(); }
  [[nodiscard]] const Eigen::Vector3d& bias() const { return bias_; }

 private:
  Config config_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d filtered_ = Eigen::Vector3d::Zero();
  bool started_ = false;
};

}  // namespace kiln
