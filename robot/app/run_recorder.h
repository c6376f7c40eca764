#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "common/config/config_archive.h"
#include "common/core/clock.h"
#include "common/core/mutex.h"
#include "common/model/device_sample.h"
#include "common/model/status.h"
#include "common/record/foxglove.h"
#include "robot/app/link_tap.h"

namespace kiln {

class RunWriter;

/// Records a run: everything that is published, and what perception and map building need to be run
/// again (raw scans, thermal frames, devices with odometry, transforms). A thread `recorder` owns
/// the file; the callers' part is one push into a bounded queue, whose newest message is dropped
/// and counted when it is full. A disk that is nearly full ends the recording, not the robot;
/// status().problem then says so. Thread-safe.
class RunRecorder {
 public:
  struct Config {
    double min_free_gb = 2.0;  ///< a recording ends when less is free on its disk
    int queue = 1024;          ///< messages that may wait, about 3 s
    bool pictures = false;     ///< take pictures for the recording though no station watches
    void visit(ConfigArchive& a);
  };
  /// What the file says of the run; fixed for the life of the process.
  struct Run {
    std::string folder;  ///< made when needed
    std::string robot_name, version, mission_uuid, environment;
    std::string config_yaml;  ///< effective configuration
    bool lossless = false;    ///< lockstep: a full queue makes the callers wait
  };

  RunRecorder(Config config, Run run, const Clock& clock);
  ~RunRecorder();  ///< ends the recording and writes its index
  RunRecorder(const RunRecorder&) = delete;
  RunRecorder& operator=(const RunRecorder&) = delete;

  /// Asks the recorder's thread to begin a new file or to end the present one; returns at once.
  void set(bool on);
  /// Messages are taken; false makes every call below a no-op.
  [[nodiscard]] bool on() const { return on_.load(std::memory_order_relaxed); }
  [[nodiscard]] RecordingStatus status() const;
  [[nodiscard]] const Config& config() const { return config_; }

  /// What OperatorLink tells: published topics, commands, acks.
  [[nodiscard]] LinkTap tap();
  void scan(PointCloudPtr scan);  ///< raw, frame `lidar`, with per-point times
  void devices(const DeviceSample& sample);
  void transforms(std::vector<foxglove::FrameTransform> tree, const Eigen::Isometry3d& X_map_base,
                  Stamp stamp);

 private:
  using Job = std::function<Result<void>(RunWriter&)>;
  struct Remembered {
    LinkTap::Encode encode;
    Stamp stamp;
  };
  void push(Job job);
  void published(Topic topic, const LinkTap::Encode& encode, Stamp now);
  void loop(std::stop_token stop);
  void begin();
  void end(const std::string& problem);
  void work(const std::deque<Job>& jobs);
  [[nodiscard]] bool diskHasSpace();  ///< false: the recording has been ended
  [[nodiscard]] bool halfFull() const {
    return 2 * jobs_.size() >= static_cast<std::size_t>(config_.queue);
  }

  const Config config_;
  const Run run_;
  const Clock& clock_;
  std::atomic<bool> on_{false};
  mutable Mutex mutex_;
  std::condition_variable_any wake_, space_;
  std::deque<Job> jobs_;                 // guarded by mutex_
  std::map<Topic, Remembered> latched_;  // guarded by mutex_
  RecordingStatus status_;               // guarded by mutex_
  bool wanted_ = false;                  // guarded by mutex_
  std::unique_ptr<RunWriter> writer_;    // recorder's thread only, as all below
  Stamp begun_, disk_checked_;
  std::jthread thread_;
};

}  // namespace kiln
