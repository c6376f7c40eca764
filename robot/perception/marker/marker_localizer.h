#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/geom/camera_model.h"
#include "robot/perception/marker/ground_cluster.h"
#include "robot/perception/marker/ground_plane.h"
#include "robot/perception/marker/marker_detector.h"
#include "robot/perception/marker/outline_fit.h"

namespace kiln {

/// Where a picture was taken, at its stamp.
struct MarkerViewpoint {
  Eigen::Isometry3d X_base_rgb = Eigen::Isometry3d::Identity();
  Pose2 X_odom_base;   ///< wheel odometry
  GroundPlane ground;  ///< at the marker (groundAlongRay()); in `base`
};

enum class MarkerRefusal : std::uint8_t {
  NothingSeen,  ///< no candidate in any picture of the window
  TooSmall,
  OneLeg,  ///< a strip instead of an L
  WrongSides,
  HalfHidden,  ///< legs, ends or corner are missing
  NoFit,       ///< the marker's outline does not lie on what is seen
  Uncertain,   ///< found, but not well enough
};
[[nodiscard]] std::string_view toString(MarkerRefusal refusal);

/// A cluster on the ground that is not taken for the marker.
struct RefusedMarker {
  MarkerRefusal why = MarkerRefusal::NothingSeen;
  std::string text;                      ///< one sentence with the figures
  marker::GroundRectangle X_odom_sides;  ///< in odom; sides are 0 when nothing was seen
};

/// The marker as found: the wall frame of wall_layout.h on the ground.
struct MarkerEstimate {
  Stamp stamp;  ///< of the newest picture
  Pose2 X_odom_wall;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< x, y (m), yaw (rad), axes of odom
  Eigen::Isometry3d X_base_wall =
      Eigen::Isometry3d::Identity();  ///< at `stamp`, on the ground there, with pitch and roll
  marker::GroundRectangle rectangle;  ///< in odom, before the fit
  Pose2 X_odom_rectangle;             ///< the wall frame by that rectangle alone
  double coverage = 0.0;              ///< share of the marker that was seen
  double outside = 0.0;               ///< share of what was seen that lies off the marker
  Eigen::Vector3d camera_turn_rad = Eigen::Vector3d::Zero();  ///< the fit's, about camera axes
  int pictures = 0;
};

struct MarkerSearch {
  std::optional<MarkerEstimate> estimate;
  std::vector<RefusedMarker> refused;  ///< largest first
};

/// Pose of the wall marker from what several pictures show of it (NimbRo UGV paper, "Wall Marker
/// Detection"): pixels of the candidates on the ground, gathered over 10 s by the odometry;
/// Euclidean clusters; smallest rectangle, its emptiest corner, side lengths. Beyond the paper the
/// ground has the tilt that the LiDAR sees, each cluster is asked (not only the largest one), the
/// marker's outline is fitted to the outlines in the pictures, and a marker of which legs, ends or
/// corner are missing is refused.
/// Confined to one thread. Memory: at most Config::max_pictures times what the detector keeps of a
/// picture.
class MarkerLocalizer {
 public:
  struct Config {
    double hfov_deg = kHeadCameraHfov_deg;
    double window_s = 10.0;
    int max_pictures = 100;
    int max_outline = 400;  ///< points kept of a picture
    double max_range_m = 16.0;
    double gap_m = 0.35;  ///< between points of one cluster on the ground
    double cell_m = 0.05;
    int min_hits = 2;                ///< points in a cell, from three pictures on
    double side_tolerance = 0.15;    ///< of a side of the rectangle, as a share
    double side_tolerance_m = 0.20;  ///< and beside that
    bool refine = true;              ///< fit the outline; false: the rectangle alone
    double camera_sigma_deg = 0.3;   ///< mounting, each axis
    double camera_sigma_m = 0.005;
    double odometry_drift = 0.01;  ///< one sigma, of the way driven since
    double min_coverage = 0.75;    ///< of each leg
    double max_outside = 0.25;
    double min_agreeing = 0.55;  ///< share of the outline
    double max_sigma_m = 0.5;    ///< of the position, along its worst axis
    double max_sigma_deg = 6.0;
    bool paper = false;  ///< the paper's choice: picture's winner and largest cluster only
    marker::OutlineFitConfig fit;
    void visit(ConfigArchive& a);
  };
  explicit MarkerLocalizer(const Config& config);
  ~MarkerLocalizer();
  MarkerLocalizer(MarkerLocalizer&&) noexcept;
  MarkerLocalizer& operator=(MarkerLocalizer&&) noexcept;

  [[nodiscard]] const CameraModel& camera() const;  ///< rgb, 1280 x 720
  /// Takes one picture's candidates. Pictures come in the order of their stamps; one that is older
  /// than the newest, and one whose poses are not finite, is left out.
  void add(const MarkerView& view, const MarkerViewpoint& from);
  [[nodiscard]] MarkerSearch search() const;
  void reset();  ///< forgets all pictures; after a reset of the odometry

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Middle ray of a view's winner, in the camera frame: where the ground is to be looked at.
/// nullopt: no winner.
[[nodiscard]] std::optional<Eigen::Vector3d> winnerRay(const MarkerView& view,
                                                       const CameraModel& camera);

}  // namespace kiln
