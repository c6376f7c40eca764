#include "robot/control/contact_monitor.h"

namespace kiln {

double ContactMonitor::update(const Eigen::Vector3d& force_n, bool at_rest, double dt_s) {
  if (!started_) {
    // The first sample seeds the mean; the slow filter alone would take seconds to learn a sensor
    // offset.
    bias_ = force_n;
    started_ = true;
  } else if (at_rest) {
    bias_ += (force_n - bias_) * (dt_s / (config_.bias_filter_s + dt_s));
  }
  if (bias_.norm() > config_.max_bias_n) bias_ *= config_.max_bias_n / bias_.norm();
  filtered_ += (force_n - bias_ - filtered_) * (dt_s / (config_.filter_s + dt_s));
  return force();
}

}  // namespace kiln
