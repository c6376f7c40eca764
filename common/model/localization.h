#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// How far the pose in `map` may be trusted, the best first.
enum class LocalizationHealth : std::uint8_t {
  Good,
  Degraded,  ///< odometry alone for a while, or uncertain by more than a goal: drive slowly
  Lost,      ///< no fix yet, or none for too long: autonomy must not drive
};
[[nodiscard]] std::string_view toString(LocalizationHealth health);  ///< "good", "degraded", "lost"

/// What the localisation believes and why, for the operator and the recording. Published at 10 Hz.
struct LocalizationStatus {
  Stamp stamp;  ///< of X_map_base
  LocalizationHealth health = LocalizationHealth::Lost;
  std::string reason;  ///< why not Good, one sentence with what to do; empty while Good
  std::string method;  ///< "surfel map", "wall map", "odometry"
  std::string submap;  ///< "outdoor" or "indoor"; empty when the map has no parts
  Eigen::Isometry3d X_map_base = Eigen::Isometry3d::Identity();
  Pose2 X_map_odom;  ///< the correction in force
  /// Of (x m, y m, yaw rad) in map.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double sigma_m = 0.0;           ///< largest 1-sigma of the position on the ground
  double sigma_yaw_rad = 0.0;     ///< 1-sigma
  double match_age_s = -1.0;      ///< since the last accepted scan match; < 0 = never
  double inlier_fraction = 0.0;   ///< of the last match, 0..1
  int observable_directions = 0;  ///< of the last match, 0..6; 5 in a straight corridor
  std::uint64_t matches = 0;      ///< accepted since start
  std::uint64_t rejected = 0;
  /// How far the robot is from the path it follows; nullopt while it follows none.
  std::optional<double> tracking_error_m;
  std::optional<double> tracking_error_yaw_rad;
  int resets = 0;  ///< counts up when the robot has been carried back; odometry starts anew
};

/// A thinned point set of the map in use, for drawing. Sent when the map changes.
struct MapLayer {
  Stamp stamp;
  std::string name;                  ///< of the map: "kitchen"
  std::uint64_t version = 0;         ///< checksum of the map file: equal versions are equal maps
  std::vector<std::string> submaps;  ///< names: "outdoor", "indoor"
  std::vector<Eigen::Vector3f> points_map;  ///< metres
  std::vector<std::uint8_t> submap_of;      ///< per point: index into `submaps`
};
/// More points than this are not sent.
inline constexpr std::size_t kMaxMapLayerPoints = 100'000;

/// What the robot has driven between two resets.
struct TrajectoryLeg {
  int resets = 0;  ///< LocalizationStatus::resets while it was driven
  std::vector<Pose2> X_map_base;
};
/// All that was driven since the daemon started, oldest leg first; thinned. Published at 1 Hz while
/// it grows.
struct Trajectory {
  Stamp stamp;
  std::vector<TrajectoryLeg> legs;
};

}  // namespace kiln
