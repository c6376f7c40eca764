#pragma once

#include <functional>
#include <string>

#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln {

/// Called on the device's thread; must return quickly (hand over to a LatestValue).
template <class T>
using Sink = std::function<void(T)>;

/// What a LiDAR's data lack.
struct LidarDefects {
  std::string text;               ///< "6 packets lost, 1 refused (...)"; empty: nothing
  double missing_fraction = 0.0;  ///< of its packets
};

/// A spinning LiDAR: one call of the sink a revolution, points in `lidar`, with per-point time.
class Lidar {
 public:
  virtual ~Lidar() = default;
  virtual Result<void> start(Sink<PointCloudPtr> sink) = 0;
  virtual void stop() = 0;
  [[nodiscard]] virtual LidarDefects defects() const { return {}; }
};

}  // namespace kiln
