#pragma once

#include <optional>
#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/camera_model.h"
#include "common/geom/pose.h"
#include "common/wire/fire/fire_model.h"

namespace kiln {

struct WarmingConfig {
  double gate_px = 25.0;      ///< a warm blob nearer than this to the place is that of the place
  double min_rise_kps = 0.1;  ///< slower is drift of the camera
  double significance = 3.0;  ///< and the rise is so many of its own sigmas
  int min_views = 8;
  void visit(ConfigArchive& a);
};

/// Whether what is warm at a place still warms: the peak of the blob that lies nearest to it, image
/// by image, and a straight line through these. A plate that was just lit is told from a thing that
/// is merely warm without knowing how either heats. Confined to the mission thread.
class WarmingTrend {
 public:
  explicit WarmingTrend(WarmingConfig config) : config_(config) {}
  /// Forgets what was seen.
  void begin(const Eigen::Vector3d& p_place_map);
  void add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal);
  /// K/s; nullopt while too few views say that it rises.
  [[nodiscard]] std::optional<double> rise() const;

 private:
  struct View {
    double t_s = 0.0;
    double peak_k = 0.0;
  };
  WarmingConfig config_;
  Eigen::Vector3d p_place_map_ = Eigen::Vector3d::Zero();
  std::optional<Stamp> first_;
  std::vector<View> views_;
};

}  // namespace kiln
