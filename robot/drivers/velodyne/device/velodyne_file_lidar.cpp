#include "robot/drivers/velodyne/device/velodyne_file_lidar.h"

#include <mutex>

#include "common/core/log.h"

namespace kiln {
namespace {
constexpr int kPriority = 5;  // between results of jobs and the mission: sensors come first
}

struct VelodyneFileLidar::Player {
  Player(std::unique_ptr<velodyne::PacketFile> f, const Config& config)
      : file(std::move(f)), assembler(config.scan) {}

  void tick(Stamp now);
  [[nodiscard]] bool fetch();
  void beginAgain();

  std::mutex mutex;
  std::unique_ptr<velodyne::PacketFile> file;
  velodyne::ScanAssembler assembler;
  Sink<PointCloudPtr> sink;
  std::optional<Stamp> origin;  ///< robot time of the file's first packet
  std::optional<velodyne::RecordedPacket> pending;
  Duration last_time{};
  std::uint64_t delivered = 0;
  int loops = 0;
};

/// @return false if there is nothing more to play.
bool VelodyneFileLidar::Player::fetch() {
  if (pending) return true;
  auto packet = file->next();
  if (packet && !packet->has_value()) {
    beginAgain();
    packet = file->next();
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
  (void)file->rewind();  // a failure shows at the next read
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
    while (sink && fetch() && *origin + pending->time <= now) {
      last_time = pending->time;
      if (pending->port == velodyne::kDataPort) {
        auto revolution = assembler.feed(pending->payload, *origin + pending->time);
        if (revolution && *revolution != nullptr) done.push_back(*revolution);
      }
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
  auto player = std::make_shared<Player>(std::move(*file), config);
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
  return player_->file->rewind();
}

void VelodyneFileLidar::stop() {
  const std::lock_guard lock(player_->mutex);
  player_->sink = nullptr;
}

velodyne::ScanStatistics VelodyneFileLidar::statistics() const {
  const std::lock_guard lock(player_->mutex);
  return player_->assembler.statistics();
}

}  // namespace kiln
