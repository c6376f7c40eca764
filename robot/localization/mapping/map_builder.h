#pragma once

#include <string>
#include <vector>

#include "robot/localization/mapping/keyframe.h"
#include "robot/localization/mapping/map_report.h"
#include "robot/localization/mapping/pose_graph.h"
#include "robot/localization/scan_matcher.h"
#include "robot/localization/surfel_map_file.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// What map building yields.
struct BuiltMap {
  LocalizationMap map;                   ///< segments "outdoor" and "indoor"
  std::vector<Eigen::Isometry3d> poses;  ///< X_map_base of every keyframe
  std::vector<Stamp> stamps;             ///< of their scans
  MapReport report;
};

/// Builds the localisation map of an arena from scans and wheel odometry, truth unseen.
///
/// Scans become keyframes by distance and turn; each is registered with the map of those before it,
/// loops are closed on return to a place, a pose graph is solved (Ceres), each keyframe is taken
/// out, registered with all others and put back, and the whole is anchored to the configured arena:
/// the floor of the building gives height, roll and pitch, its walls x, y and yaw. Two maps are
/// made of it, one about the way to the door and one about the inside (NimbRo UGV paper, "Laser
/// Navigation").
/// Use: addScan() for each scan in order (startRun() before each further recording), then build().
/// Thread-compatible.
class MapBuilder {
 public:
  struct Config {
    double keyframe_distance_m = 0.4;
    double keyframe_turn_deg = 15.0;
    int max_keyframes = 400;
    double odometry_sigma_m = 0.02;              ///< of a step, and
    double odometry_sigma_per_m = 0.05;          ///< of each metre
    double odometry_sigma_deg = 0.5;             ///< yaw, of a step
    double odometry_tilt_sigma_deg = 3.0;        ///< roll, pitch: the ground may bend
    double loop_distance_m = 1.2;                ///< nearer keyframes are the same place
    int loop_gap = 12;                           ///< keyframes that must lie in between
    int loop_neighbours = 2;                     ///< on each side of the old one make its local map
    int polish_rounds = 2;                       ///< take out, register, put back
    double overlap_m = 2.0;                      ///< of the two maps, each side of the doorway
    SurfelMap::Config working{0.2, 3, 128, 32};  ///< map while building
    SurfelMap::Config shipped;                   ///< of each segment
    ScanMatcher::Config matcher;
    void visit(ConfigArchive& a);
  };

  /// @param arena  nominal walls and start: gives the frame.
  MapBuilder(Config config, const ArenaMap& arena);

  /// The next scan comes from another recording whose odometry starts anew; it is found in the map
  /// built so far by a wide search about `X_map_base_near`.
  void startRun(const Pose2& X_map_base_near);
  /// @return whether it became a keyframe. Error: Degenerate if it should have, but does not fit
  ///         the map (the scan is left out; the next one is tried).
  [[nodiscard]] Result<bool> addScan(PointCloud scan_base, const Pose2& X_odom_base,
                                     const Eigen::Vector3d& p_base_sensor);
  /// Error: Degenerate if there are fewer than three keyframes or the walls cannot be found.
  [[nodiscard]] Result<BuiltMap> build();
  [[nodiscard]] std::size_t keyframes() const { return keyframes_.size(); }

 private:
  [[nodiscard]] bool isFarFromLast(const Pose2& X_odom_base) const;
  void accept(Keyframe keyframe, const Eigen::Isometry3d& X_map_base);
  void addOdometryEdge(const Keyframe& keyframe);
  [[nodiscard]] Result<ScanMatch> registerFirst(const Keyframe& keyframe) const;
  void closeLoops();
  void closeLoop(int old_node, int new_node);
  void polish();
  [[nodiscard]] std::shared_ptr<SurfelMap> mapOf(const std::vector<int>& nodes,
                                                 const SurfelMap::Config& config,
                                                 const Eigen::Vector3d& p_map_center) const;
  [[nodiscard]] Result<void> anchor(MapReport& report);
  [[nodiscard]] LocalizationMap segments(MapReport& report) const;

  Config config_;
  ArenaMap arena_;
  Eigen::Isometry3d X_map_base_near_;
  bool new_run_ = true;
  std::vector<Keyframe> keyframes_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<PoseEdge> edges_;
  std::vector<SurfelMap::ScanId> inserted_;
  std::shared_ptr<SurfelMap> working_;
  MapReport report_;
};

}  // namespace kiln
