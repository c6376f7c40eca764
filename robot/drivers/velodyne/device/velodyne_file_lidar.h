#pragma once

#include <memory>
#include <string>

#include "common/core/clock.h"
#include "common/core/executor.h"
#include "robot/drivers/velodyne/device/capture_check.h"
#include "robot/hal/lidar.h"

namespace kiln {

/// A recorded VLP-16 as if it were there: plays a capture at the pace of the sensor's own clock and
/// begins again at its end (said once in the log, as is what is missing in the file). Revolutions
/// that would join end and beginning are left out. Thread-safe; the sink is called on the
/// executor's tick thread `io.lidar`.
class VelodyneFileLidar final : public Lidar {
 public:
  struct Config {
    velodyne::ScanAssembler::Config scan;
    Duration tick = std::chrono::milliseconds(5);  ///< how often due packets are looked for
  };
  /// Opens and checks the whole file, and registers the tick: call it before the executor starts.
  /// Error: one sentence with file, place and what to do: missing, cut off, not a capture, another
  /// sensor's packets. Stray packets are passed over and counted.
  [[nodiscard]] static Result<std::unique_ptr<VelodyneFileLidar>> open(const std::string& path,
                                                                       Executor& executor,
                                                                       Config config);
  [[nodiscard]] static Result<std::unique_ptr<VelodyneFileLidar>> open(const std::string& path,
                                                                       Executor& executor) {
    return open(path, executor, Config{});
  }
  ~VelodyneFileLidar() override;

  Result<void> start(Sink<PointCloudPtr> sink) override;
  void stop() override;
  [[nodiscard]] LidarDefects defects() const override;

  /// Of the file as a whole, from the check at opening.
  [[nodiscard]] const velodyne::CaptureSummary& summary() const { return summary_; }
  /// While playing.
  [[nodiscard]] velodyne::ScanStatistics statistics() const;

 private:
  struct Player;
  VelodyneFileLidar(std::shared_ptr<Player> player, velodyne::CaptureSummary summary);
  std::shared_ptr<Player> player_;  ///< shared with the tick, which may outlive the device
  velodyne::CaptureSummary summary_;
};

}  // namespace kiln
