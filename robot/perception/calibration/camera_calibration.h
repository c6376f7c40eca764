#pragma once

#include <span>

#include "common/config/config_archive.h"
#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/perception/calibration/extrinsics.h"

namespace kiln {

/// A picture of the operator camera while the robot was at rest.
struct RobotPicture {
  RgbImagePtr picture;
  Vector6d q = Vector6d::Zero();  ///< joint angles meanwhile
};

/// Mounting pose of the operator camera, which stands fixed on the base: the edges of the robot's
/// deck, tanks and head are drawn where the camera is thought to be, looked for in the pictures
/// across each edge, and brought together (after Harris and Stennett 1990, "RAPID"). The head,
/// taken to several places, is what holds the camera's position: the deck alone lies in one plane
/// and half of it is hidden by the arm.
class CameraCalibrator {
 public:
  struct Config {
    double hfov_deg = 78.0;
    double sample_m = 0.02;       ///< between two points of an edge
    double search_px = 18.0;      ///< across an edge, in the first rounds; a third at last
    double min_step_grey = 14.0;  ///< difference of brightness that counts as an edge
    double noise_px = 2.0;        ///< of a found edge point; neighbours on an edge err together
    double prior_m = 0.006, prior_deg = 0.4;  ///< of the mounting: tolerance of the workshop
    int rounds = 14;
    int min_points = 40;
    void visit(ConfigArchive& a);
  };
  explicit CameraCalibrator(Config config) : config_(config) {}
  /// @param pictures  in daylight, the arm in several postures.
  /// @return Error{Degenerate} when too few edges are seen, or they do not hold all directions.
  [[nodiscard]] Result<Extrinsics> calibrate(std::span<const RobotPicture> pictures,
                                             const RobotGeometry& robot,
                                             const Eigen::Isometry3d& X_base_camera) const;

 private:
  Config config_;
};

}  // namespace kiln
