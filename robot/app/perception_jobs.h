#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/core/bounded_queue.h"
#include "common/core/executor.h"
#include "common/core/latest_value.h"
#include "common/model/sensor.h"
#include "robot/app/state_history.h"
#include "robot/localization/localizer.h"
#include "robot/localization/scan_locator.h"
#include "robot/perception/cloud/obstacle_memory.h"
#include "robot/perception/cloud/pose_track.h"
#include "robot/perception/cloud/self_filter.h"

namespace kiln {

/// Carries scans to the perception functions that every mission needs and their results back: sinks
/// run on device threads and only fill mailboxes, dispatch() and the take functions belong to the
/// mission thread, the work runs on the pool.
class PerceptionJobs {
 public:
  struct Config {
    double scan_latency_s = 0.012;      ///< modelled in lockstep; median of its benchmark
    double moving_fix_period_s = 0.1;   ///< locate at most so often while the base moves
    double resting_fix_period_s = 0.5;  ///< and at rest
    void visit(ConfigArchive& a);
  };
  struct ScanResult {
    PointCloudPtr cloud;  ///< motion-compensated, without the robot itself; frame base (or lidar)
    Stamp end;            ///< when its last point was measured
    AlignmentPrior prior;
    std::optional<Result<ScanMatch>> match;  ///< nullopt: not tried this time
    double locate_s = 0.0;                   ///< wall time of it, in lockstep too
    /// X_base_lidar over the scan; nullptr when the robot's motion during it is not known.
    std::shared_ptr<const PoseTrack> lidar_track;
    /// Obstacles in the scan; nullopt when the robot's motion during the scan is not known.
    std::optional<ObstacleScan> obstacles;
  };
  PerceptionJobs(Config config, Executor& executor, const RobotGeometry& robot,
                 const StateHistory& history, const SelfFilter& self_filter,
                 const ScanLocator& locator, const ObstacleMemory::Config& obstacles);

  void onScan(PointCloudPtr scan);  ///< any thread
  /// Posts jobs for what has arrived. `localizer` gives the prior; `moving` chooses how often to
  /// locate.
  void dispatch(Stamp now, Localizer& localizer, bool moving);
  [[nodiscard]] std::vector<ScanResult> takeScans();
  /// Stamp of the newest scan that came from the sensor, of its last point ...
  [[nodiscard]] std::optional<Stamp> lastScan() const { return last_scan_; }
  /// ... and of the newest whose result was taken: while the sensor delivers, the two go together.
  [[nodiscard]] std::optional<Stamp> lastCloud() const { return last_cloud_; }
  [[nodiscard]] std::uint64_t droppedFrames() const;

 private:
  [[nodiscard]] ScanResult processScan(const PointCloud& scan,
                                       const std::optional<AlignmentPrior>& prior) const;

  Config config_;
  Executor& executor_;
  const RobotGeometry& robot_;
  const StateHistory& history_;
  const SelfFilter& self_filter_;
  const ScanLocator& locator_;
  ObstacleMemory::Config obstacles_;
  LatestValue<PointCloudPtr> scans_;
  BoundedQueue<ScanResult> scan_results_{4, DropPolicy::Oldest};
  std::optional<Stamp> last_scan_, last_cloud_, last_fix_try_;
  std::uint64_t refused_jobs_ = 0;  ///< frames whose kind was still being worked on
};

}  // namespace kiln
