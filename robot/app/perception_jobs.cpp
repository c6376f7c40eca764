#include "robot/app/perception_jobs.h"

#include <utility>

#include "common/core/clock.h"
#include "robot/app/scan_preparation.h"

namespace kiln {
namespace {

constexpr double kHalfScan_s = 0.05;

}  // namespace

void PerceptionJobs::Config::visit(ConfigArchive& a) {
  a.field("scan_latency_s", scan_latency_s, "s", 0, 1, "modelled latency of one scan in lockstep");
  a.field("moving_fix_period_s", moving_fix_period_s, "s", 0.05, 10,
          "locate at most so often while moving, or lost");
  a.field("resting_fix_period_s", resting_fix_period_s, "s", 0.05, 60,
          "locate at most so often at rest");
}

PerceptionJobs::PerceptionJobs(Config config, Executor& executor, const RobotGeometry& robot,
                               const StateHistory& history, const SelfFilter& self_filter,
                               const ScanLocator& locator, const ObstacleMemory::Config& obstacles)
    : config_(config),
      executor_(executor),
      robot_(robot),
      history_(history),
      self_filter_(self_filter),
      locator_(locator),
      obstacles_(obstacles) {}

void PerceptionJobs::onScan(PointCloudPtr scan) { scans_.put(std::move(scan)); }

void PerceptionJobs::dispatch(Stamp now, Localizer& localizer, bool moving) {
  const auto scan = scans_.takeFresh();
  if (!scan) return;
  last_scan_ = scanEnd(**scan);
  const bool searching = localizer.relocateTries() > 0;  // over the arena, a place a scan
  const double period_s =
      moving || searching ? config_.moving_fix_period_s : config_.resting_fix_period_s;
  // Scans come at nearly the period: half a scan of slack keeps every one of them.
  const bool due = !last_fix_try_ || now - *last_fix_try_ >= fromSeconds(period_s - kHalfScan_s);
  const auto prior = due ? localizer.priorAt((*scan)->stamp) : std::nullopt;
  if (prior) last_fix_try_ = now;
  const bool posted =
      executor_.post({"scan", fromSeconds(config_.scan_latency_s),
                      [this, scan = *scan, prior](std::stop_token) -> Delivery {
                        auto result = std::make_shared<ScanResult>(processScan(*scan, prior));
                        return [this, result] { scan_results_.push(std::move(*result)); };
                      }});
  if (!posted) ++refused_jobs_;
}

PerceptionJobs::ScanResult PerceptionJobs::processScan(
    const PointCloud& scan, const std::optional<AlignmentPrior>& prior) const {
  ScanResult result;
  result.end = scanEnd(scan);
  result.prior = prior.value_or(AlignmentPrior{});
  PreparedScan prepared = prepareScan(scan, robot_, history_, self_filter_);
  result.cloud = std::move(prepared.cloud);
  result.lidar_track = std::move(prepared.X_base_lidar);
  if (!result.lidar_track) return result;
  const Eigen::Isometry3d X_base_lidar = result.lidar_track->at(scan.stamp);
  result.obstacles = ObstacleMemory::observe(obstacles_, *result.cloud, X_base_lidar);
  if (prior) {
    const SteadyClock wall;
    const Stamp begin = wall.now();
    result.match = locator_.locate(*result.cloud, X_base_lidar.translation(), *prior);
    result.locate_s = toSeconds(wall.now() - begin);
  }
  return result;
}

std::vector<PerceptionJobs::ScanResult> PerceptionJobs::takeScans() {
  auto results = scan_results_.drain();
  if (!results.empty()) last_cloud_ = results.back().end;
  return results;
}

std::uint64_t PerceptionJobs::droppedFrames() const {
  return scans_.overwritten() + scan_results_.dropped() + refused_jobs_;
}

}  // namespace kiln
