#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "common/core/clock.h"
#include "robot/hal/device_set.h"
#include "robot/sim/world.h"

namespace kiln::sim {

/// Offers one World on a local socket (proto/kiln/v1/device.proto) to one robot at a time.
///
/// Lockstep: the world moves on Advance only, on the calling thread. Real time: it moves with the
/// clock; operator pictures are rendered on a thread of lower priority. When a robot's connection
/// closes (also by kill -9), the next hello is accepted and finds the world as it stands: device
/// fail-safes have acted meanwhile.
class WorldServer {
 public:
  struct Config {
    std::string endpoint;  ///< ipc://PATH or tcp://127.0.0.1:PORT, nothing else
    bool lockstep = false;
    std::string version;     ///< must equal the robot's
    std::string truth_path;  ///< empty: no truth report
    std::string trace_path;  ///< empty: no trace
    double trace_rate_hz = 10.0;
    DeviceSet devices = {DeviceKind::Pumps, DeviceKind::Lidar, DeviceKind::ThermalCamera,
                         DeviceKind::OperatorCamera};  ///< that the robot has
  };
  /// Binds. Errors: InvalidInput (endpoint), Unavailable (in use), Storage (trace cannot be
  /// written).
  [[nodiscard]] static Result<std::unique_ptr<WorldServer>> create(const Config& config,
                                                                   World& world,
                                                                   const Clock& clock);
  ~WorldServer();
  /// Runs until `stop` is set, then writes the truth report. The report is also written at each
  /// bye.
  [[nodiscard]] Result<void> run(const std::atomic<bool>& stop);

 private:
  struct Impl;
  explicit WorldServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::sim
