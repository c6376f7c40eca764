#pragma once

#include "robot/hal/lidar.h"

namespace kiln {

/// A colour camera. In this release: the rear-top operator camera.
class RgbCamera {
 public:
  virtual ~RgbCamera() = default;
  virtual Result<void> start(Sink<RgbImagePtr> sink) = 0;
  virtual void stop() = 0;
};

}  // namespace kiln
