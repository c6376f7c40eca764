#pragma once

#include "robot/hal/lidar.h"

namespace kiln {

/// A colour camera: the rear-top operator camera, or the one in the head.
class RgbCamera {
 public:
  virtual ~RgbCamera() = default;
  virtual Result<void> start(Sink<RgbImagePtr> sink) = 0;
  virtual void stop() = 0;
};

}  // namespace kiln
