#include "robot/app/standstill.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kiln {
namespace {

constexpr double kJointRest_radps = 0.02;
constexpr double kWheelRest_radps = 0.1;
constexpr double kPumpRest_a = 0.3;
constexpr double kProofAge_s = 0.1;
constexpr double kAhead_s = 0.02;  // clocks of devices and robot
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

template <class State>
bool young(const std::optional<State>& state, Stamp now) {
  if (!state) return false;
  const double age_s = toSeconds(now - state->stamp);
  return age_s <= kProofAge_s && age_s >= -kAhead_s;
}

}  // namespace

void proveStandstill(StopStatus& status, const std::optional<ArmState>& arm,
                     const std::optional<BaseState>& base, const std::optional<PumpsState>& pumps,
                     Stamp now) {
  // Written so that NaN is not at rest.
  status.arm_at_rest = young(arm, now) && (arm->qd.array().abs() <= kJointRest_radps).all();
  status.base_at_rest =
      young(base, now) && std::all_of(base->wheels.begin(), base->wheels.end(), [](const auto& w) {
        return std::abs(w.drive_radps) <= kWheelRest_radps;
      });
  status.pumps_at_rest =
      young(pumps, now) && std::all_of(pumps->current_a.begin(), pumps->current_a.end(),
                                       [](double a) { return std::abs(a) < kPumpRest_a; });
  status.standstill_proven =
      status.latched && status.arm_at_rest && status.base_at_rest && status.pumps_at_rest;
}

double knownOf(const std::optional<BaseState>& base, double BaseState::*number, Stamp now) {
  return young(base, now) ? (*base).*number : kUnknown;
}

Twist2 knownTwist(const Twist2& measured, const std::optional<BaseState>& base, Stamp now) {
  return young(base, now) ? measured : Twist2{kUnknown, kUnknown, kUnknown};
}

}  // namespace kiln
