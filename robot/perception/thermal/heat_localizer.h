#pragma once

#include <memory>
#include <optional>

#include "common/config/config_archive.h"
#include "common/geom/camera_model.h"
#include "common/model/fire.h"
#include "common/model/sensor.h"

namespace kiln {

/// Fuses heat detections over an arm sweep into a 3D position: distance from the half-maximum blob area (known plate
/// size) fused with triangulation over the views; the parallax of the opening (aperture in front of a recessed plate)
/// is modelled. Beside it the paper's bounding-box distance as a baseline. Confined to one thread.
class HeatLocalizer {
 public:
  struct Config {
    double plate_diameter_m = 0.15;
    double opening_m = 0.15;
    double recess_m = 0.10;
    double hfov_deg = 57.0;
    int min_views = 5;
    double max_range_m = 3.0;
    void visit(ConfigArchive& a);
  };
  explicit HeatLocalizer(Config config);
  ~HeatLocalizer();
  /// Starts a new sweep: forgets all views.
  void begin();
  /// Adds one image's detections seen from X_map_thermal at the image's stamp; best blob only, gated against the estimate.
  /// @param normal_prior  expected outward direction of the opening in map (unit), from the configured place.
  void add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal,
           const Eigen::Vector3d& normal_prior);
  /// nullopt until min_views views agree.
  [[nodiscard]] std::optional<FireEstimate> estimate() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
