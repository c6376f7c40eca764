#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/config/config_archive.h"
#include "common/core/error.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/scene/pile_layout.h"

namespace kiln {

/// Where the pile may be: an upright rectangle.
struct SearchArea {
  Eigen::Isometry3d X_base_area = Eigen::Isometry3d::Identity();
  double half_x_m = 3.0, half_y_m = 3.0;
  Eigen::Vector3d x_expected =
      Eigen::Vector3d::UnitX();  ///< of the pile's X, in base, to tell it from its opposite
};

/// One cluster that was looked at.
struct PileCandidate {
  Eigen::Vector3d p_base = Eigen::Vector3d::Zero();  ///< middle of its outline, on the ground
  double yaw_rad = 0.0;                              ///< of its longer axis in base
  double length_m = 0.0, width_m = 0.0, height_m = 0.0;
  int points = 0;
  std::string refused;  ///< why it is not the pile's front line; empty: it is
};

struct PileDetection {
  Eigen::Isometry3d X_base_pile = Eigen::Isometry3d::Identity();  ///< Z along the ground's normal
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();       ///< x, y, yaw in base; m, rad
  bool second_line = false;                                       ///< line 2 was seen behind it
  GroundFit ground;
};

/// What a detection looked at, whether or not it found a pile.
struct PileSearch {
  std::vector<PileCandidate> candidates;  ///< largest first
  std::vector<PileDetection> found;       ///< one, or none
  std::string why;                        ///< none was found: what is missing, one sentence
};

/// Finds the pile from farther away: geofence, ground plane, clusters of what stands on it, size
/// gate, principal components; X along the longest axis, Z up, perpendicular to the plane (NimbRo
/// UGV paper, "Rough Pile Detection"). Line 2 behind the front line, where it is seen, says which
/// way Y points; without it the expected direction does. Thread-compatible.
class PileDetector {
 public:
  struct Config {
    double leaf_m = 0.04;
    double gap_m = 0.35;  ///< stacks nearer to each other are one cluster
    int min_points = 25;  ///< leaves; fewer: ignored
    double length_tolerance_m = 0.5, max_width_m = 0.75;
    double min_height_m = 0.7, max_height_m = 1.25;
    double line_tolerance_m = 0.4, line_tolerance_deg = 15.0;  ///< of line 2 against line 1
    SweepPreparation ground;
    void visit(ConfigArchive& a);
  };
  explicit PileDetector(const Config& config) : config_(config) {}

  /// @param sweep   one or several scans in base.
  /// @param layout  of the pile that is looked for.
  /// @return Error{Degenerate}: nothing in the area, or no ground; a search without a pile is no
  ///         Error.
  [[nodiscard]] Result<PileSearch> detect(const BrickSweep& sweep, const SearchArea& area,
                                          const PileLayout& layout) const;

 private:
  [[nodiscard]] std::string whyNot(const PileCandidate& candidate, double length_m,
                                   int layers) const;
  Config config_;
};

}  // namespace kiln
