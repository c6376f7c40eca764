#pragma once

#include "common/config/config_archive.h"
#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/perception/calibration/extrinsics.h"

namespace kiln {

/// Mounting pose of the operator camera from one picture: it looks over the robot's own deck and
/// tanks, whose edges are drawn where the camera is thought to be, looked for in the picture across
/// each edge, and brought together (after Harris and Stennett 1990, "RAPID"). The arm hides some of
/// them; where it is, is known from its joints.
class CameraCalibrator {
 public:
  struct Config {
    double hfov_deg = 78.0;
    double sample_m = 0.02;       ///< between two points of an edge
    double search_px = 18.0;      ///< across an edge, in the first rounds; a third at last
    double min_step_grey = 14.0;  ///< difference of brightness that counts as an edge
    double noise_px = 0.7;
    double prior_m = 0.01, prior_deg = 1.0;  ///< one picture holds position only weakly
    int rounds = 14;
    int min_points = 40;
    void visit(ConfigArchive& a);
  };
  explicit CameraCalibrator(Config config) : config_(config) {}
  /// @param picture  of a robot at rest, in daylight.
  /// @param q        joint angles meanwhile.
  /// @return Error{Degenerate} when too few edges are seen, or they do not hold all directions.
  [[nodiscard]] Result<Extrinsics> calibrate(const RgbImage& picture, const RobotGeometry& robot,
                                             const Vector6d& q,
                                             const Eigen::Isometry3d& X_base_camera) const;

 private:
  Config config_;
};

}  // namespace kiln
