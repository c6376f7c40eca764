#pragma once

#include <optional>
#include <vector>

#include "robot/localization/pose_tracker.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// Where the robot is, on the mission thread: the tracked pose, the map in use, and the way back
/// when both have been lost.
///
/// Outside the building scans are matched with the outdoor map, inside with the indoor one; the
/// switch comes before the doorway, with hysteresis, because inside and outside points lie close
/// together there (paper, "Laser Navigation" and "Evaluation"). When the pose is lost, scans are
/// searched around the last belief first, then around the places of the mission and then over the
/// whole arena, one place a scan; what is found so must be found again in the next scan before it
/// counts. Thread-compatible.
class Localizer {
 public:
  struct Config {
    double switch_before_door_m = 1.2;  ///< the indoor map from here on
    double switch_back_m = 2.2;         ///< and the outdoor map again from here
    double relocate_spacing_m = 1.6;    ///< of the places searched over the arena
    double relocate_step_deg = 36.0;    ///< of the headings tried at each
    double confirm_m = 0.10;            ///< two scans must agree so well
    double confirm_deg = 1.5;
    double confirm_inlier_fraction = 0.6;
    PoseTracker::Config tracker;
    void visit(ConfigArchive& a);
  };

  Localizer(const Config& config, const ArenaMap& arena, const RobotGeometry& robot);

  /// The robot was put down near `X_map_base`, on the ground as it was surveyed.
  void reset(const Pose2& X_map_base, Stamp now);
  void addOdometry(Stamp stamp, const Pose2& X_odom_base);
  /// What to match the scan of time `t` with; nullopt if there is no odometry for it.
  [[nodiscard]] std::optional<AlignmentPrior> priorAt(Stamp t);
  /// What became of it. @return whether the pose was corrected.
  bool addResult(const AlignmentPrior& prior, const Result<ScanMatch>& match);
  [[nodiscard]] TrackedPose pose(Stamp now) const { return tracker_.pose(now); }
  [[nodiscard]] std::optional<Pose2> odometryAt(Stamp t) const { return tracker_.odometryAt(t); }
  [[nodiscard]] Submap submap() const { return submap_; }
  /// Places tried since the pose was lost; 0 while it is not.
  [[nodiscard]] int relocateTries() const { return tries_; }

 private:
  [[nodiscard]] Submap submapAt(const Pose2& X_map_base, Submap current) const;
  [[nodiscard]] Eigen::Isometry3d onNominalGround(const Pose2& X_map_base) const;
  [[nodiscard]] std::vector<Pose2> placesToSearch() const;
  void confirm(const AlignmentPrior& prior, const ScanMatch& match);

  Config config_;
  ArenaMap arena_;
  RobotGeometry robot_;
  GroundProfile ground_;
  PoseTracker tracker_;
  Submap submap_ = Submap::Outdoor;
  std::vector<Pose2> places_;  ///< searched one after the other while lost
  std::optional<Stamp> now_;
  std::optional<AlignmentPrior> candidate_;  ///< found once, waits for the second scan
  int tries_ = 0;
};

}  // namespace kiln
