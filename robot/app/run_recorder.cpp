#include "robot/app/run_recorder.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>
#include <pthread.h>

#include "common/core/log.h"
#include "common/record/record_file.h"
#include "common/record/run_topics.h"
#include "robot/app/run_writer.h"

namespace kiln {
namespace {

// The thread looks by itself instead of being woken by each message: 300 a second come, and a wake
// costs the caller more than the push.
constexpr auto kLook = std::chrono::milliseconds(40);
constexpr double kDiskCheck_s = 1.0;

/// "bob-20260131T120000Z-3f0c9a1b.mcap"; a number is added when the name is taken.
std::string fileName(const std::string& robot, const std::string& utc, const std::string& mission,
                     const std::string& folder) {
  std::string name;
  for (const char c : robot + "-" + utc) {
    if (c == '-' && name.size() > robot.size()) continue;
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  name += "-" + mission.substr(0, 8);
  std::string path = folder + "/" + name + ".mcap";
  for (int i = 2; std::filesystem::exists(path); ++i)
    path = fmt::format("{}/{}-{}.mcap", folder, name, i);
  return path;
}

}  // namespace

void RunRecorder::Config::visit(ConfigArchive& a) {
  a.field("min_free_gb", min_free_gb, "GB", 0.05, 10000,
          "a recording ends when less is free on its disk");
  a.field("queue", queue, "", 64, 65536, "messages that may wait for the recorder");
  a.field("pictures", pictures, "take pictures for the recording though no station watches");
}

RunRecorder::RunRecorder(Config config, Run run, const Clock& clock)
    : config_(config), run_(std::move(run)), clock_(clock) {
  thread_ = std::jthread([this](std::stop_token stop) { loop(stop); });
}

RunRecorder::~RunRecorder() {
  thread_.request_stop();
  wake_.notify_all();
  space_.notify_all();
}

void RunRecorder::set(bool on) {
  const std::lock_guard lock(mutex_);
  wanted_ = on;
  if (on) status_.problem.clear();
  on_.store(on);  // from now on messages are kept for it
}

RecordingStatus RunRecorder::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void RunRecorder::push(Job job) {
  if (!on()) return;
  std::unique_lock lock(mutex_);
  const auto full = [this] { return jobs_.size() >= static_cast<std::size_t>(config_.queue); };
  if (full() && run_.lossless)
    space_.wait(lock, thread_.get_stop_token(), [&] { return !full() || !on_.load(); });
  if (full()) {
    ++status_.dropped;
    return;
  }
  jobs_.push_back(std::move(job));
  if (halfFull()) wake_.notify_one();
}

void RunRecorder::published(Topic topic, const LinkTap::Encode& encode, Stamp now) {
  if (topicInfo(topic).latched) {
    const std::lock_guard lock(mutex_);
    latched_[topic] = {encode, now};
  }
  push([topic, encode, now](RunWriter& writer) { return writer.published(topic, encode(), now); });
}

LinkTap RunRecorder::tap() {
  LinkTap tap;
  tap.published = [this](Topic topic, const LinkTap::Encode& encode, Stamp now) {
    published(topic, encode, now);
  };
  tap.command = [this](const Command& command, Stamp received) {
    push([command, received](RunWriter& writer) { return writer.command(command, received); });
  };
  tap.ack = [this](const CommandAck& ack, Stamp now) {
    push([ack, now](RunWriter& writer) { return writer.ack(ack, now); });
  };
  return tap;
}

void RunRecorder::scan(PointCloudPtr scan) {
  const Stamp now = clock_.now();
  push([scan = std::move(scan), now](RunWriter& writer) { return writer.scan(*scan, now); });
}

void RunRecorder::devices(const DeviceSample& sample) {
  push([sample](RunWriter& writer) { return writer.devices(sample); });
}

void RunRecorder::transforms(std::vector<foxglove::FrameTransform> tree,
                             const Eigen::Isometry3d& X_map_base, Stamp stamp) {
  push([tree = std::move(tree), X_map_base, stamp](RunWriter& writer) {
    auto written = writer.transforms(tree, stamp);
    return written ? writer.pose(stamp, X_map_base) : written;
  });
}

// --- recorder's thread

void RunRecorder::loop(std::stop_token stop) {
  pthread_setname_np(pthread_self(), "recorder");
  bool last = false;
  while (!last) {
    std::deque<Job> jobs;
    bool wanted = false;
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, stop, kLook, [this] { return halfFull(); });
      last = stop.stop_requested();
      jobs.swap(jobs_);
      wanted = wanted_;
    }
    space_.notify_all();
    if (wanted && !writer_) begin();
    work(jobs);
    if (writer_ && (!wanted || last)) end("");
  }
}

void RunRecorder::begin() {
  begun_ = disk_checked_ = clock_.now();
  const std::string utc = wallTimeIso8601();
  std::error_code ignored;  // the file says what is wrong with its folder
  std::filesystem::create_directories(run_.folder, ignored);
  if (!diskHasSpace()) return;
  const std::string path = fileName(run_.robot_name, utc, run_.mission_uuid, run_.folder);
  auto writer = RunWriter::create(path, "kiln " + run_.version);
  if (!writer) return end(writer.error().message);
  writer_ = std::move(*writer);
  std::map<Topic, Remembered> latched;
  {
    const std::lock_guard lock(mutex_);
    status_.on = true;
    status_.file = std::filesystem::path(path).filename().string();
    latched = latched_;
  }
  logger("record")->info("recording to {}", path);
  const nlohmann::json about = {{"robot_name", run_.robot_name},
                                {"version", run_.version},
                                {"mission_uuid", run_.mission_uuid},
                                {"environment", run_.environment},
                                {"started_utc", utc},
                                {"started_robot_s", toSeconds(begun_)}};
  std::deque<Job> first;
  first.push_back([&](RunWriter& w) {
    return w.file().attach(std::string(run::kRunAttachment), "application/json", about.dump(2),
                           begun_);
  });
  first.push_back([&](RunWriter& w) {
    return w.file().attach(std::string(run::kConfigAttachment), "application/yaml",
                           run_.config_yaml, begun_);
  });
  for (const auto& [topic, value] : latched) {
    first.push_back([&, topic = topic, encode = value.encode](RunWriter& w) {
      return w.published(topic, encode(), begun_);
    });
  }
  work(first);
}

void RunRecorder::end(const std::string& problem) {
  if (writer_) {
    const auto closed = writer_->file().close();
    logger("record")->info("recording ended: {}, {:.1f} MB{}", writer_->file().path(),
                           1e-6 * static_cast<double>(writer_->file().bytesWritten()),
                           closed ? "" : "; without an index: " + closed.error().message);
    writer_.reset();
  }
  const std::lock_guard lock(mutex_);
  status_.on = false;
  if (problem.empty()) return;
  status_.problem = problem;
  wanted_ = false;
  on_.store(false);
  jobs_.clear();
}

void RunRecorder::work(const std::deque<Job>& jobs) {
  if (!writer_) return;
  Result<void> done;
  for (const Job& job : jobs) {
    done = job(*writer_);
    if (!done && done.error().code == ErrorCode::Storage) return end(done.error().message);
    if (!done) logger("record")->warn("{}", done.error().message);
  }
  const Stamp now = clock_.now();
  done = writer_->file().flushIfDue(now);
  if (!done) return end(done.error().message);
  {
    const std::lock_guard lock(mutex_);
    status_.duration_s = toSeconds(now - begun_);
    status_.bytes = writer_->file().bytesWritten();
  }
  if (toSeconds(now - disk_checked_) < kDiskCheck_s) return;
  disk_checked_ = now;
  (void)diskHasSpace();
}

bool RunRecorder::diskHasSpace() {
  const auto free = freeDiskBytes(run_.folder);
  if (!free) {
    end(free.error().message);
    return false;
  }
  const double free_bytes = static_cast<double>(*free);
  {
    const std::lock_guard lock(mutex_);
    status_.disk_free_bytes = free_bytes;
  }
  if (free_bytes >= config_.min_free_gb * 1e9) return true;
  end(fmt::format("{}: {:.1f} GB are free, less than the limit of {:.1f} GB", run_.folder,
                  free_bytes * 1e-9, config_.min_free_gb));
  return false;
}

}  // namespace kiln
