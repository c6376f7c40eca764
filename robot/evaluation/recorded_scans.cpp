#include "robot/evaluation/recorded_scans.h"

#include <deque>

#include "common/core/log.h"
#include "common/record/foxglove.h"
#include "common/record/record_reader.h"
#include "common/record/run_topics.h"
#include "common/wire/recording.h"
#include "robot/app/state_history.h"
#include "robot/perception/cloud/range_bias.h"
#include "robot/perception/cloud/self_filter.h"
#include "robot/perception/cloud/undistort.h"

namespace kiln {
namespace {

constexpr int kTrackSamples = 11;  // every 10 ms of a revolution
constexpr std::size_t kMaxWaiting = 20;

/// Scans wait here until the motion over the whole of them is known.
class ScanPreparation {
 public:
  explicit ScanPreparation(const RobotGeometry& robot) : robot_(robot), filter_(robot, {}) {}

  void add(const DeviceSample& sample) {
    if (sample.resets != resets_) {
      resets_ = sample.resets;
      history_.clear();
      waiting_.clear();
    }
    if (sample.arm) history_.addJoints(sample.arm->stamp, sample.arm->q);
    history_.addOdometry(sample.base ? sample.base->stamp : sample.stamp, sample.X_odom_base);
    newest_ = sample.stamp;
  }
  void add(PointCloud scan) {
    waiting_.push_back(std::move(scan));
    if (waiting_.size() > kMaxWaiting) {
      waiting_.pop_front();
      ++count_.without_motion;
    }
  }
  [[nodiscard]] std::optional<RecordedScan> next() {
    while (!waiting_.empty() && endOf(waiting_.front()) <= newest_) {
      const PointCloud scan = std::move(waiting_.front());
      waiting_.pop_front();
      auto prepared = prepare(scan);
      ++(prepared ? count_.scans : count_.without_motion);
      if (prepared) return prepared;
    }
    return std::nullopt;
  }
  [[nodiscard]] RecordedScanCount& count() { return count_; }

 private:
  static Stamp endOf(const PointCloud& scan) {
    return scan.stamp + fromSeconds(scan.time_offset_s.empty() ? 0.0 : scan.time_offset_s.back());
  }
  [[nodiscard]] std::optional<RecordedScan> prepare(const PointCloud& scan) const {
    const auto first = history_.at(scan.stamp);
    if (!first) return std::nullopt;
    const Duration length = endOf(scan) - scan.stamp;
    const Pose2 X_base0_odom = inverse(first->X_odom_base);
    ArmTrack arm;
    PoseTrack X_base_lidar;
    for (int i = 0; i < kTrackSamples; ++i) {
      const Stamp t = scan.stamp + length * i / (kTrackSamples - 1);
      const auto sample = history_.at(t);
      if (!sample) return std::nullopt;
      arm.push(t, sample->q);
      X_base_lidar.push(t, toIsometry(X_base0_odom * sample->X_odom_base) *
                               robot_.X_base_flange(sample->q) * robot_.X_flange_lidar.pose());
    }
    RecordedScan out;
    PointCloud cloud = filter_.filter(scan, arm).cloud;
    correctRanges(cloud, robot_.lidar_range_bias_m);
    out.scan_base = undistort(cloud, X_base_lidar, "base");
    out.X_odom_base = first->X_odom_base;
    out.p_base_sensor = X_base_lidar.at(scan.stamp).translation();
    out.resets = resets_;
    return out;
  }

  const RobotGeometry& robot_;
  SelfFilter filter_;
  StateHistory history_;
  std::deque<PointCloud> waiting_;
  Stamp newest_;
  std::uint32_t resets_ = 0;
  RecordedScanCount count_;
};

}  // namespace

Result<RecordedScanCount> forEachScan(const std::string& path, const RobotGeometry& robot,
                                      const std::function<Result<void>(RecordedScan)>& sink) {
  auto reader = RecordReader::open(path);
  if (!reader) return tl::make_unexpected(reader.error());
  for (const auto topic : {run::kDevices, run::kLidarScan}) {
    if (const auto has = run::requireMessages(*reader, topic); !has)
      return tl::make_unexpected(has.error());
  }
  if (const std::string defects = reader->defects(); !defects.empty())
    logger("record")->warn("{}: {}", path, defects);
  ScanPreparation preparation(robot);
  RecordCursor cursor =
      reader->messages({std::string(run::kLidarScan), std::string(run::kDevices)});
  while (true) {
    const auto message = cursor.next();
    if (!message) {
      logger("record")->warn("{}", message.error().message);
      ++preparation.count().damaged;
      continue;
    }
    if (!*message) break;
    if ((*message)->topic == run::kDevices) {
      const auto sample = wire::decodeDeviceSample((*message)->data);
      sample ? preparation.add(*sample) : void(++preparation.count().damaged);
    } else {
      auto scan = foxglove::decodePointCloud((*message)->data);
      scan ? preparation.add(std::move(*scan)) : void(++preparation.count().damaged);
    }
    while (auto ready = preparation.next()) {
      if (auto taken = sink(std::move(*ready)); !taken) return tl::make_unexpected(taken.error());
    }
  }
  return preparation.count();
}

}  // namespace kiln
