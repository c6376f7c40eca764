#pragma once

#include <functional>

#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln {

/// Called on the device's thread; must return quickly (hand over to a LatestValue).
template <class T>
using Sink = std::function<void(T)>;

/// A spinning LiDAR: one call of the sink a revolution, points in `lidar`, with per-point time.
class Lidar {
 public:
  virtual ~Lidar() = default;
  virtual Result<void> start(Sink<PointCloudPtr> sink) = 0;
  virtual void stop() = 0;
};

}  // namespace kiln
