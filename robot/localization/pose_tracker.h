#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "common/config/config_archive.h"
#include "common/core/stamp.h"
#include "common/geom/pose.h"
#include "robot/localization/scan_matcher.h"

namespace kiln {

/// Which part of the building's map is in use (paper, "Laser Navigation").
enum class Submap : std::uint8_t { Outdoor, Indoor };
[[nodiscard]] std::string_view toString(Submap submap);

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
  Eigen::Isometry3d X_map_base_3d = Eigen::Isometry3d::Identity();  ///< on the ground as it slopes
  PoseHealth health = PoseHealth::Lost;
  std::string reason;    ///< why not Good, in words; empty when Good
  double age_s = -1.0;   ///< since the last accepted fix; < 0 = never
  double sigma_m = 0.0;  ///< largest 1-sigma of the position
  double sigma_yaw_rad = 0.0;
  double distance_since_fix_m = 0.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x m, y m, yaw rad) in map
  double inlier_fraction = 0.0;                          ///< of the last fix
  int observable_directions = 0;                         ///< of the last fix, 0..6
  std::uint64_t fixes = 0, rejected = 0;
};

/// What an alignment job needs: taken on the mission thread, carried through the pool, handed back
/// with the result.
struct AlignmentPrior {
  Stamp stamp;
  Pose2 X_odom_base;                                                ///< at `stamp`
  Pose2 X_map_base;                                                 ///< predicted, at `stamp`
  Eigen::Isometry3d X_map_base_3d = Eigen::Isometry3d::Identity();  ///< the same on the slope
  bool search = false;      ///< the belief is only good to a metre and 20 degrees
  std::uint64_t epoch = 0;  ///< counts resets: a fix from before a reset is ignored
  Submap submap = Submap::Outdoor;
  bool elsewhere = false;  ///< not the tracker's belief: a guess while lost (Localizer)
};

/// Chains wheel odometry with LiDAR fixes: X_map_base = X_map_odom * X_odom_base.
///
/// A Kalman filter of the error of (x, y, yaw): odometry adds uncertainty by distance and turn, a
/// fix takes it away in the directions it observed. Height and tilt come from the fixes alone
/// (there is no IMU); between two of them the base is taken to follow the plane it stood on. The
/// correction for control is slewed, so that a fix never makes the robot jump; only the first fix
/// after a reset, and one that replaces a failed belief, is taken at once. A search that ends far
/// from the belief makes the pose Lost first, so that the robot stands before it is somewhere else.
/// Typical use, on the mission thread:
///   tracker.reset(X_map_base, now);
///   each tick: tracker.addOdometry(now, base.tracking().X_odom_base);  use tracker.pose(now)
///   each scan: if (auto prior = tracker.priorAt(scan.stamp)) post a job that calls a ScanLocator,
///   and on delivery
///              tracker.addFix(*prior, match) or tracker.addFailure(*prior, why).
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
    double walk_sigma_deg = 0.05;          ///< the filter listening
    double gate_sigmas = 4.0;              ///< a fix further off than this is rejected
    int search_after_rejections = 5;       ///< then the next scans search widely
    int lost_after_rejections = 12;        ///< a good second without one believable scan
    double carried_m = 0.25;               ///< a search that ends so far from the belief means that
    double carried_deg = 5.0;              ///< the robot was carried: lost, before it counts
    double carried_inlier_fraction = 0.6;  ///< the map must explain so much of a scan there
    double correction_rate_mps = 0.25;     ///< slew of the correction used by control
    double correction_rate_deg_s = 8.0;
    double good_sigma_m = 0.05;
    double good_age_s = 1.5;
    double lost_age_s = 20.0;
    double lost_distance_m = 1.5;  ///< driven since the last fix
    double lost_sigma_m = 0.40;
    double history_s = 3.0;      ///< odometry kept for late scans
    bool odometry_only = false;  ///< no fixes at all: to show what odometry is worth
    void visit(ConfigArchive& a);
  };

  explicit PoseTracker(Config config) : config_(config) {}

  /// The robot was put down near `X_map_base`; odometry starts anew (competition reset, start,
  /// operator's word). On the level floor: the first fix says how it slopes.
  void reset(const Eigen::Isometry3d& X_map_base, Stamp now);
  /// Wheel odometry at `stamp`, in order; older or non-finite values are ignored.
  void addOdometry(Stamp stamp, const Pose2& X_odom_base);
  /// X_odom_base interpolated at `t`; nullopt if `t` lies before the kept history. After the
  /// newest: the newest.
  [[nodiscard]] std::optional<Pose2> odometryAt(Stamp t) const;
  /// nullopt before the first odometry or if `t` is too old.
  [[nodiscard]] std::optional<AlignmentPrior> priorAt(Stamp t) const;
  /// @return false if the fix was refused (outlier, or from before a reset).
  bool addFix(const AlignmentPrior& prior, const ScanMatch& match);
  /// The scan was not matched (Degenerate): counts towards a search, changes no pose.
  void addFailure(const AlignmentPrior& prior, const std::string& why);
  [[nodiscard]] TrackedPose pose(Stamp now) const;

 private:
  struct OdometrySample {
    Stamp stamp;
    Pose2 X_odom_base;
  };
  void predict(const Pose2& X_old_new, double dt_s);
  void slew(double dt_s);
  [[nodiscard]] Eigen::Isometry3d onGround(const Pose2& X_map_base) const;
  [[nodiscard]] PoseHealth health(const TrackedPose& pose, std::string& reason) const;

  Config config_;
  std::deque<OdometrySample> odometry_;
  Pose2 X_map_odom_;          // filter's estimate
  Pose2 X_map_odom_control_;  // slewed
  Pose2 X_map_base_reset_;    // where a reset put the robot, until odometry arrives
  bool anchored_ = false;     // odometry has arrived since the reset
  bool has_fix_ = false;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Identity();
  // The plane the base stands on.
  Eigen::Vector3d ground_point_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d ground_normal_ = Eigen::Vector3d::UnitZ();
  Stamp last_fix_;
  std::string last_failure_;
  double inlier_fraction_ = 0.0;
  int observable_directions_ = 0;
  double distance_since_fix_m_ = 0.0;
  int rejected_in_a_row_ = 0;
  bool carried_ = false;  // a search found the robot far from the belief
  std::uint64_t fixes_ = 0, rejected_ = 0, epoch_ = 0;
};

}  // namespace kiln
