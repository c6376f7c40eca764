#pragma once

#include "common/client/operator_session.h"
#include "common/transport/clock_sync.h"
#include "common/transport/monotonic.h"

namespace kiln {

/// Judges how well each side hears the other. Thread-compatible.
class LinkWatch {
 public:
  LinkWatch(double degraded_after_s, double lost_after_s)
      : degraded_after_s_(degraded_after_s), lost_after_s_(lost_after_s) {}

  /// Anything arrived from the robot.
  void heard(Monotonic::time_point now);
  /// The robot answered a heartbeat that left here `age_s` ago: our word is at least that fresh
  /// there.
  void robotHeardUs(double age_s, Monotonic::time_point now);
  void accepted();                          ///< hello answered with yes
  void refused(const std::string& reason);  ///< ... or with no

  /// Fills state, reason and ages.
  void report(Monotonic::time_point now, LinkReport& out) const;
  [[nodiscard]] bool isAccepted() const { return accepted_; }
  [[nodiscard]] std::optional<double> rxAge(Monotonic::time_point now) const;

 private:
  [[nodiscard]] std::optional<double> upAge(Monotonic::time_point now) const;

  double degraded_after_s_;
  double lost_after_s_;
  bool accepted_ = false;
  std::string refusal_;
  std::optional<Monotonic::time_point> heard_;
  std::optional<Monotonic::time_point>
      robot_heard_us_;  ///< when the newest heartbeat that it answered left here
};

}  // namespace kiln
