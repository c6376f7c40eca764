#pragma once

#include <memory>
#include <optional>

#include "common/config/config_archive.h"
#include "common/geom/camera_model.h"
#include "common/model/sensor.h"
#include "common/wire/fire/fire_model.h"

namespace kiln {

/// Fuses heat detections over an arm sweep into a 3D position: distance from the half-maximum blob
/// area (known plate size) fused with triangulation over the views; the parallax of the opening
/// (aperture in front of a recessed plate) is modelled. Beside it the paper's bounding-box distance
/// as a baseline. Confined to one thread.
class HeatLocalizer {
 public:
  struct Config {
    double plate_diameter_m = 0.15;
    double opening_m = 0.15;
    double recess_m = 0.10;
    double hfov_deg = 57.0;
    int min_views = 5;
    double max_range_m = 3.0;
    double psf_sigma_px = 0.58;     ///< blur of optics and pixel together
    double gate_px = 12.0;          ///< a view whose centre is off by more does not agree
    double gate_size_ratio = 0.35;  ///< nor one whose size is off by more than this share
    double centre_sigma_px = 0.5;   ///< one sigma, each picture
    double radius_sigma_px = 0.25;
    double size_sigma_ratio = 0.015;    ///< plate size and focal length, common to all pictures
    double normal_yaw_sigma_deg = 5.0;  ///< the fire box stands askew
    double extrinsic_sigma_m = 0.005;   ///< camera on the flange, common to all pictures
    double extrinsic_sigma_deg = 0.3;
    void visit(ConfigArchive& a);
  };
  explicit HeatLocalizer(Config config);
  ~HeatLocalizer();
  HeatLocalizer(HeatLocalizer&&) noexcept;
  HeatLocalizer& operator=(HeatLocalizer&&) noexcept;
  /// Starts a new sweep: forgets all views.
  void begin();
  /// Adds one image's detections seen from X_map_thermal at the image's stamp. Every accepted blob
  /// that lies wholly in the picture becomes a view; estimate() uses the largest set of views that
  /// agree on one place.
  /// @param normal_prior  expected outward direction of the opening in map (unit), from the
  /// configured place.
  void add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal,
           const Eigen::Vector3d& normal_prior);
  /// nullopt until min_views views agree. `p_map` is the plate's centre (recess_m behind the
  /// opening); `covariance` includes what all views share: extrinsics, plate size, yaw of the box.
  /// Computed at most once per add(); cost: tests/bench/perception_thermal_bench.
  [[nodiscard]] std::optional<FireEstimate> estimate() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
