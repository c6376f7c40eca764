#include "robot/drivers/velodyne/device/velodyne_file_lidar.h"

#include <mutex>

#include "common/core/log.h"

namespace kiln {
namespace {
constexpr int kPriority = 5;         // between results of jobs and the mission: sensors come first
constexpr int kPacketsATick = 1000;  // 1.3 s of them
constexpr Duration kFarBehind = std::chrono::seconds(1);
}  // namespace

struct VelodyneFileLidar::Player {
  Player(std::unique_ptr<velodyne::PacketFile> f, velodyne::SensorKey sensor, const Config& config)
      : file(std::move(f)), stream(*file, sensor), assembler(config.scan) {}

  void tick(Stamp now);
  [[nodiscard]] bool fetch();
  void beginAgain();

  std::mutex mutex;
  std::unique_ptr<velodyne::PacketFile> file;
  velodyne::CaptureStream stream;
  velodyne::ScanAssembler assembler;
  Sink<PointCloudPtr> sink;
  std::optional<Stamp> origin;  ///< robot time of the file's first data packet
  std::optional<velodyne::SequencedPacket> pending;
  Duration last_time{};
  int loops = 0;
};

/// @return false if there is nothing more to play.
bool VelodyneFileLidar::Player::fetch() {
  if (pending) return true;
  auto packet = stream.next();
  if (packet && !packet->has_value()) {
    beginAgain();
    packet = stream.next();
  }
  if (!packet || !packet->has_value()) {
    logger("driver.velodyne")
        ->error("{}", packet ? "the capture became empty" : packet.error().message);
    sink = nullptr;
    return false;
  }
  pending = std::move(**packet);
  return true;
}

void VelodyneFileLidar::Player::beginAgain() {
  if (loops++ == 0) {
    logger("driver.velodyne")
        ->info("{}: end reached after {} revolutions; playing it again and again", file->path(),
               assembler.statistics().revolutions);
  }
  (void)stream.rewind();  // a failure shows at the next read
  assembler.restart();
  *origin += last_time + std::chrono::milliseconds(1);
}

void VelodyneFileLidar::Player::tick(Stamp now) {
  std::vector<PointCloudPtr> done;
  Sink<PointCloudPtr> out;
  {
    const std::lock_guard lock(mutex);
    if (!sink) return;
    if (!origin) origin = now;
    for (int i = 0; i < kPacketsATick && fetch() && *origin + pending->time <= now; ++i) {
      last_time = pending->time;
      const Stamp due = *origin + pending->time;
      if (now - due > kFarBehind) {  // we were held up: nobody wants to see that again in haste
        *origin += now - due;
        assembler.restart();
      }
      auto revolution = assembler.feed(pending->payload, *origin + pending->time);
      if (revolution && *revolution != nullptr) done.push_back(*revolution);
      pending.reset();
    }
    out = sink;
  }
  if (!out) return;
  for (auto& cloud : done) out(std::move(cloud));
}

Result<std::unique_ptr<VelodyneFileLidar>> VelodyneFileLidar::open(const std::string& path,
                                                                   Executor& executor,
                                                                   Config config) {
  auto file = velodyne::openPacketFile(path);
  if (!file) return tl::make_unexpected(file.error());
  auto summary = velodyne::checkCapture(**file, config.scan);
  if (!summary) return tl::make_unexpected(summary.error());
  if (const std::string defects = velodyne::defectsOf(*summary); !defects.empty())
    logger("driver.velodyne")->warn("{}: {}", path, defects);
  auto player = std::make_shared<Player>(std::move(*file), summary->sensor, config);
  executor.every(config.tick, "io.lidar", kPriority, [player](Stamp now) { player->tick(now); });
  return std::unique_ptr<VelodyneFileLidar>(new VelodyneFileLidar(std::move(player), *summary));
}

VelodyneFileLidar::VelodyneFileLidar(std::shared_ptr<Player> player,
                                     velodyne::CaptureSummary summary)
    : player_(std::move(player)), summary_(std::move(summary)) {}

VelodyneFileLidar::~VelodyneFileLidar() { stop(); }

Result<void> VelodyneFileLidar::start(Sink<PointCloudPtr> sink) {
  const std::lock_guard lock(player_->mutex);
  if (player_->sink)
    return makeError(ErrorCode::Refused, "the LiDAR is already running; stop it first");
  player_->sink = std::move(sink);
  player_->origin.reset();
  player_->pending.reset();
  player_->assembler.restart();
  return player_->stream.rewind();
}

void VelodyneFileLidar::stop() {
  const std::lock_guard lock(player_->mutex);
  player_->sink = nullptr;
}

LidarDefects VelodyneFileLidar::defects() const {
  const double missing = static_cast<double>(summary_.scan.lost + summary_.link.incomplete);
  return {velodyne::defectsOf(summary_),
          missing / (missing + static_cast<double>(summary_.data_packets))};
}

velodyne::ScanStatistics VelodyneFileLidar::statistics() const {
  const std::lock_guard lock(player_->mutex);
  return player_->assembler.statistics();
}

}  // namespace kiln
