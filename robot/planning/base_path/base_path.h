#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/planning/path_timing.h"

namespace kiln {

struct BasePathConfig {
  double speed_mps = 1.0;
  double approach_speed_mps = 0.3;  ///< within approach_distance_m of the end
  double approach_distance_m = 0.6;
  double yaw_rate_radps = 0.5;
  double accel_mps2 = 0.5;       ///< along the path; also across it in curves
  double jerk_time_s = 0.25;     ///< ramp of the acceleration
  double corner_radius_m = 0.3;  ///< way-points are passed within this
  double turn_weight_m = 0.9;  ///< 1 rad of turning counts as this much way (the wheels' lever arm)
  double step_m = 0.02;
  void visit(ConfigArchive& a);
};

/// Smooth, timed path of the base through way-points in map: straight lines, heading turning evenly
/// along each, corners rounded, at rest at both ends. Thread-compatible.
class BasePath {
 public:
  struct Point {
    Pose2 X_map_base;
    Twist2 v_map;    ///< velocity in map axes (not in base), yaw rate
    double s = 0.0;  ///< path coordinate, m
  };
  /// @pre waypoints_map has at least one finite pose.
  BasePath(const Pose2& X_map_start, const std::vector<Pose2>& waypoints_map,
           const BasePathConfig& config);
  [[nodiscard]] double duration() const { return timing_.duration(); }
  [[nodiscard]] double length() const { return s_.back(); }
  [[nodiscard]] Point at(double t_s) const;
  /// Pose at path coordinate s, clamped to the path.
  [[nodiscard]] Pose2 poseAt(double s) const;
  /// Index of the way-point that lies ahead at path coordinate s.
  [[nodiscard]] int nextWaypoint(double s) const;
  [[nodiscard]] const std::vector<Pose2>& samples() const { return poses_; }

 private:
  static double wayBetween(const Pose2& from, const Pose2& to, const BasePathConfig& config);
  void appendLine(const Pose2& to, const BasePathConfig& config);
  void roundCorners(const BasePathConfig& config);
  [[nodiscard]] std::vector<PathTiming::Sample> limits(const BasePathConfig& config) const;
  [[nodiscard]] Twist2 slope(std::size_t k) const;

  std::vector<double> s_;
  std::vector<Pose2> poses_;  ///< yaw unwrapped
  std::vector<std::size_t> waypoint_sample_;
  PathTiming timing_;
};

/// The first known box that the robot's footprint would touch along the path, by name. Boxes that
/// it touches at the start do not count: it may leave them.
[[nodiscard]] std::optional<std::string> firstObstacle(const BasePath& path, double length_m,
                                                       double width_m,
                                                       const std::vector<BoxConfig>& boxes_map);

}  // namespace kiln
