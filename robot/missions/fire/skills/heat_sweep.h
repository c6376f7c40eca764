#pragma once

#include <optional>

#include "common/geom/pose.h"
#include "common/wire/fire/fire_model.h"

namespace kiln {

/// Fuses the heat detections of one arm sweep into a position. An interface, because perception
/// works behind it (HeatLocalizer, wired in robot/app). Confined to the mission thread.
class HeatSweep {
 public:
  virtual ~HeatSweep() = default;
  /// Forgets all views.
  virtual void begin() = 0;
  /// @param normal_prior_map  expected outward direction of the opening, unit.
  virtual void add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal,
                   const Eigen::Vector3d& normal_prior_map) = 0;
  /// nullopt until enough views agree: nothing found is a value, not an error.
  [[nodiscard]] virtual std::optional<FireEstimate> estimate() const = 0;
};

}  // namespace kiln
