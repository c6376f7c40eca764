#pragma once

#include <memory>
#include <string>

#include "common/core/manual_executor.h"
#include "common/core/thread_executor.h"
#include "robot/app/absent_devices.h"
#include "robot/app/devices.h"
#include "robot/app/recorded_run.h"
#include "robot/app/recorded_sensors.h"
#include "robot/sim_link/sim_link.h"

namespace kiln {

/// Where a robot's devices come from; from the command line, empty = not from there.
struct DeviceSources {
  std::string sim;             ///< endpoint of kiln-sim
  std::string lidar, thermal;  ///< captures of single sensors
  std::string replay;          ///< a recorded run; stands alone
  bool lockstep = false;       ///< step together with kiln-sim
};

/// The world or recorded files, and the clock and executor that fit.
class Runtime {
 public:
  [[nodiscard]] Result<void> open(const DeviceSources& sources, const std::string& version);
  [[nodiscard]] Devices devices();
  [[nodiscard]] const Clock& clock() const {
    return manual ? static_cast<const Clock&>(manual_clock)
                  : static_cast<const Clock&>(steady_clock);
  }
  [[nodiscard]] Executor& executor() {
    return manual ? static_cast<Executor&>(*manual) : static_cast<Executor&>(*threads);
  }

  SteadyClock steady_clock;
  ManualClock manual_clock;
  std::unique_ptr<ManualExecutor> manual;   ///< lockstep and replay
  std::unique_ptr<ThreadExecutor> threads;  ///< real time
  std::unique_ptr<SimLink> sim;
  std::unique_ptr<RecordedRun> run;

 private:
  AbsentDevices absent_;
  RecordedSensors recorded_;
};

}  // namespace kiln
