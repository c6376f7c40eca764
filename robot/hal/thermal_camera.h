#pragma once

#include "robot/hal/lidar.h"

namespace kiln {

/// A radiometric camera (Lepton 3.5): every frame, also frozen ones, with its telemetry.
class ThermalCamera {
 public:
  virtual ~ThermalCamera() = default;
  virtual Result<void> start(Sink<ThermalImagePtr> sink) = 0;
  virtual void stop() = 0;
};

}  // namespace kiln
