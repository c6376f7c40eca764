#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/config/config_archive.h"
#include "common/core/clock.h"
#include "robot/hal/arena.h"
#include "robot/hal/arm.h"
#include "robot/hal/device_set.h"
#include "robot/hal/drive_base.h"
#include "robot/hal/gripper.h"
#include "robot/hal/lidar.h"
#include "robot/hal/pumps.h"
#include "robot/hal/rgb_camera.h"
#include "robot/hal/storage.h"
#include "robot/hal/thermal_camera.h"

namespace kiln {

/// The robot's devices as kiln-sim offers them: what kiln-robotd sees of the simulator, and no
/// truth.
///
/// Lockstep: commands are buffered until advanceTo(), which sends them, waits for the world's one
/// answer and calls the sensor sinks on the calling thread. Stamps are the world's own time. Start
/// the daemon's ManualClock with `clock.advanceTo(link->world().now)`: a world that outlived a
/// daemon does not begin at zero.
///
/// Real time: a thread `io.sim` owns the socket; commands leave at once, sinks are called on that
/// thread. The world's time is mapped to the daemon's clock: offset = min(daemon time - world time)
/// over the reports of the last 2 s, so that a stamp is late by at most the least transport delay,
/// and never lies in the future. After `silence_s` without a report connected() is false, commands
/// are refused with Unavailable and a new hello is sent every half second; sensors go on by
/// themselves after a reconnect.
///
/// Device accessors are thread-safe in real time; in lockstep everything is confined to one thread.
class SimLink {
 public:
  struct Config {
    std::string endpoint =
        "ipc:///tmp/kiln-sim";  ///< ipc://PATH or tcp://127.0.0.1:PORT, nothing else
    bool lockstep = false;
    double hello_timeout_s = 5.0;  ///< how long connect() waits for the world
    double silence_s = 1.0;  ///< real time: no report for so long means that the world is lost
    double lockstep_timeout_s = 60.0;  ///< advanceTo() gives up after so much wall time
    std::string version;               ///< set by the program (KILN_VERSION), not in the file
    void visit(ConfigArchive& a);
  };
  /// What the world said at the hello.
  struct World {
    std::string name;
    std::uint64_t seed = 0;
    Stamp now;                 ///< world time at the hello (lockstep: start your clock here)
    Duration device_period{};  ///< a report each so often in real time
    DeviceSet devices;         ///< that this robot has; the others' accessors give silent ones
  };

  /// Connects and says hello. Errors: InvalidInput (endpoint), Unavailable (nobody answers),
  /// VersionMismatch, Refused (another daemon holds the robot, lockstep against real time), each in
  /// one sentence.
  [[nodiscard]] static Result<std::unique_ptr<SimLink>> connect(const Config& config,
                                                                const Clock& clock);
  ~SimLink();  ///< says bye: the world writes its truth report
  SimLink(const SimLink&) = delete;
  SimLink& operator=(const SimLink&) = delete;

  [[nodiscard]] Arm& arm();
  [[nodiscard]] DriveBase& base();
  [[nodiscard]] Pumps& pumps();
  [[nodiscard]] Lidar& lidar();
  [[nodiscard]] ThermalCamera& thermalCamera();
  [[nodiscard]] RgbCamera& operatorCamera();
  [[nodiscard]] RgbCamera& headCamera();
  [[nodiscard]] Gripper& gripper();
  [[nodiscard]] Storage& storage();
  [[nodiscard]] Arena& arena();

  /// Lockstep only: sends what was commanded since the last call, lets the world run to `until` and
  /// takes over its report. @pre until >= the last one. Error: Unavailable when the world is gone
  /// or silent.
  [[nodiscard]] Result<void> advanceTo(Stamp until);
  /// advanceTo() in two halves, so that the robot can think while the world moves: what is
  /// commanded between them takes effect in the step after. One finishStep() for each beginStep().
  [[nodiscard]] Result<void> beginStep(Stamp until);
  [[nodiscard]] Result<void> finishStep();

  [[nodiscard]] const World& world() const;
  [[nodiscard]] bool lockstep() const;
  /// Real time: reports come in. Lockstep: the last advanceTo() succeeded.
  [[nodiscard]] bool connected() const;
  /// Since the newest report, in the daemon's clock; nullopt before the first.
  [[nodiscard]] std::optional<Duration> lastReportAge() const;
  /// Counts up when the robot has been carried back to its start.
  [[nodiscard]] std::optional<std::uint32_t> resets() const;
  /// Last device-level refusal in words, e.g. a servo target out of limits; empty if none.
  [[nodiscard]] std::string refusal() const;
  /// Hellos after the first (the world was lost and came back).
  [[nodiscard]] std::uint32_t reconnects() const;

 private:
  struct Impl;
  explicit SimLink(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
