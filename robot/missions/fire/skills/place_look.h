#pragma once

#include <optional>
#include <string>

#include "common/geom/pose.h"
#include "common/wire/fire/place_check.h"

namespace kiln {

/// Compares where a place was configured with where the live cloud shows it. An interface, because
/// perception works behind it (PlaceTask). Confined to the mission thread.
class PlaceLook {
 public:
  virtual ~PlaceLook() = default;
  /// Asks where the box stands. The answer comes some ticks later; a new question forgets the one
  /// before.
  virtual void begin(const std::string& place, const Eigen::Isometry3d& X_map_front) = 0;
  [[nodiscard]] virtual std::optional<PlaceCheck> answer() const = 0;
};

}  // namespace kiln
