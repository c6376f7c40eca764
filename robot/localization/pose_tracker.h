#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "common/config/config_archive.h"
#include "common/core/stamp.h"
#include "common/geom/pose.h"
#include "robot/localization/box_map_aligner.h"

namespace kiln {

enum class PoseHealth : std::uint8_t {
  Lost,      ///< no fix yet, or none for too long: autonomy must not drive
  Degraded,  ///< odometry alone for a while, or uncertain by more than a goal
  Good,
};
[[nodiscard]] std::string_view toString(PoseHealth health);

/// What the tracker believes.
struct TrackedPose {
  Stamp stamp;       ///< of the newest odometry
  Pose2 X_map_base;  ///< for control: corrections come in at a limited rate
  Pose2 X_map_odom;  ///< the correction itself
  PoseHealth health = PoseHealth::Lost;
  double age_s = -1.0;   ///< since the last accepted fix; < 0 = never
  double sigma_m = 0.0;  ///< largest 1-sigma of the position
  double sigma_yaw_rad = 0.0;
  double distance_since_fix_m = 0.0;
  std::uint64_t fixes = 0, rejected = 0;
};

/// What an alignment job needs: taken on the mission thread, carried through the pool, handed back
/// with the result.
struct AlignmentPrior {
  Stamp stamp;
  Pose2 X_odom_base;        ///< at `stamp`
  Pose2 X_map_base;         ///< predicted, at `stamp`
  bool search = false;      ///< call BoxMapAligner::search, not align
  std::uint64_t epoch = 0;  ///< counts resets: a fix from before a reset is ignored
};

/// Chains wheel odometry with LiDAR fixes: X_map_base = X_map_odom * X_odom_base.
///
/// A Kalman filter of the error of (x, y, yaw): odometry adds uncertainty by distance and turn, a
/// fix takes it away in the directions it observed. The correction for control is slewed, so that a
/// fix never makes the robot jump; only the first fix after a reset is taken at once. Typical use,
/// on the mission thread:
///   tracker.reset(arena.start.pose(), now);
///   each tick: tracker.addOdometry(now, base.tracking().X_odom_base);  use tracker.pose(now)
///   each scan: if (auto prior = tracker.priorAt(scan.stamp)) post a job that calls align() or
///   search(), and on delivery
///              tracker.addFix(*prior, alignment) or tracker.addFailure(*prior).
/// Thread-compatible.
class PoseTracker {
 public:
  struct Config {
    double start_sigma_m = 0.20;  ///< where the robot is put down (scenario.md section 3)
    double start_sigma_deg = 5.0;
    double drift_per_metre = 0.03;         ///< 1-sigma position drift, m per m driven
    double yaw_drift_per_metre_deg = 0.6;  ///< 1-sigma, deg per m driven
    double yaw_drift_per_turn = 0.03;      ///< 1-sigma, rad per rad turned
    double walk_sigma_m =
        0.003;  ///< 1-sigma after one second at rest (pushes, floor, model): keeps
    double walk_sigma_deg = 0.05;       ///< the filter listening
    double gate_sigmas = 4.0;           ///< a fix further off than this is rejected
    int search_after_rejections = 5;    ///< then the next scans search widely
    double correction_rate_mps = 0.25;  ///< slew of the correction used by control
    double correction_rate_deg_s = 8.0;
    double good_sigma_m = 0.05;
    double good_age_s = 1.5;
    double lost_age_s = 20.0;
    double lost_sigma_m = 0.40;
    double history_s = 3.0;  ///< odometry kept for late scans
    void visit(ConfigArchive& a);
  };

  explicit PoseTracker(Config config) : config_(config) {}

  /// The robot was put down near `X_map_base`; odometry starts anew (competition reset, start,
  /// operator's word).
  void reset(const Pose2& X_map_base, Stamp now);
  /// Wheel odometry at `stamp`, in order; older or non-finite values are ignored.
  void addOdometry(Stamp stamp, const Pose2& X_odom_base);
  /// X_odom_base interpolated at `t`; nullopt if `t` lies before the kept history. After the
  /// newest: the newest.
  [[nodiscard]] std::optional<Pose2> odometryAt(Stamp t) const;
  /// nullopt before the first odometry or if `t` is too old.
  [[nodiscard]] std::optional<AlignmentPrior> priorAt(Stamp t) const;
  /// @return false if the fix was refused (outlier, or from before a reset).
  bool addFix(const AlignmentPrior& prior, const Alignment& alignment);
  /// The alignment failed (Degenerate): counts towards a search, changes no pose.
  void addFailure(const AlignmentPrior& prior);
  [[nodiscard]] TrackedPose pose(Stamp now) const;

 private:
  struct OdometrySample {
    Stamp stamp;
    Pose2 X_odom_base;
  };
  void predict(const Pose2& X_old_new, double dt_s);
  void slew(double dt_s);

  Config config_;
  std::deque<OdometrySample> odometry_;
  Pose2 X_map_odom_;          // filter's estimate
  Pose2 X_map_odom_control_;  // slewed
  Pose2 X_map_base_reset_;    // where a reset put the robot, until odometry arrives
  bool anchored_ = false;     // odometry has arrived since the reset
  bool has_fix_ = false;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Identity();
  Stamp last_fix_;
  double distance_since_fix_m_ = 0.0;
  int rejected_in_a_row_ = 0;
  std::uint64_t fixes_ = 0, rejected_ = 0, epoch_ = 0;
};

}  // namespace kiln
