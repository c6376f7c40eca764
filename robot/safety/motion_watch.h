#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "common/config/config_archive.h"
#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// How the source of its STOP begins.
inline constexpr std::string_view kMotionWatchSource = "motion watch: ";

/// Does the base do what it is told? Holds the commanded motion against what the wheels measure,
/// and what the wheels measure against localisation (NimbRo UGV paper: "a faulty controller caused
/// the robot to drive towards the arena boundary, even though localization and waypoints were
/// correct"). What it finds is latched as a STOP by its owner. Confined to the mission thread.
class MotionWatch {
 public:
  struct Config {
    double lag_s = 0.35;  ///< the wheels may follow a command within this time
    double speed_tolerance_mps = 0.08;
    double yaw_tolerance_radps = 0.18;
    double share = 0.5;     ///< or so much of the commanded speed, whichever is more
    double hold_s = 0.35;   ///< a disagreement counts after this long
    double window_s = 2.0;  ///< wheels against localisation over this time
    double way_tolerance_m = 0.35;
    double way_share = 0.30;  ///< and so much of the way
    double turn_tolerance_deg = 10.0;
    double way_hold_s = 1.5;  ///< counts after this long: a mission that is stuck stops by itself
    void visit(ConfigArchive& a);
  };
  struct Input {
    Stamp stamp;
    Twist2 commanded;   ///< after all limits, base frame
    Twist2 measured;    ///< from the wheels
    Pose2 X_odom_base;  ///< wheel odometry
    /// Localised pose; nullopt when there is none to be trusted (lost, or searching).
    std::optional<Pose2> X_map_base;
  };
  explicit MotionWatch(Config config) : config_(config) {}
  /// One tick. @return what is wrong, in one sentence; empty when nothing is.
  [[nodiscard]] std::string step(const Input& input);
  /// After a reset, a set pose, a cleared STOP: forgets everything.
  void restart();

 private:
  struct Sample {
    Stamp stamp;
    Twist2 commanded;
    Pose2 X_odom_base;
    std::optional<Pose2> X_map_base;
  };
  [[nodiscard]] static bool lasts(std::optional<Stamp>& since, bool now_so, double hold_s,
                                  Stamp now);
  [[nodiscard]] std::string wheelsAgainstCommand(const Input& input);
  [[nodiscard]] std::string wheelsAgainstLocalisation(const Input& input) const;

  Config config_;
  std::deque<Sample> samples_;
  std::optional<Stamp> disagree_since_, slips_since_;
};

}  // namespace kiln
