#include "robot/drivers/lepton/device/lepton_file_camera.h"

#include <mutex>

#include "common/core/log.h"
#include "robot/drivers/lepton/link/still_file.h"

namespace kiln {
namespace {
constexpr int kPriority = 5;  // between results of jobs and the mission: sensors come first
}

struct LeptonFileCamera::Player {
  void tick(Stamp now);

  std::mutex mutex;
  Config config;
  std::vector<std::string> names;
  std::vector<ThermalImage> images;
  Sink<ThermalImagePtr> sink;
  std::uint64_t shown = 0;
};

void LeptonFileCamera::Player::tick(Stamp now) {
  Sink<ThermalImagePtr> out;
  auto image = std::make_shared<ThermalImage>();
  {
    const std::lock_guard lock(mutex);
    if (!sink) return;
    out = sink;
    *image = images[shown / static_cast<std::uint64_t>(config.frames_per_still) % images.size()];
    image->seq = shown;
    image->frame_counter = static_cast<std::uint32_t>(shown);
    ++shown;
  }
  image->stamp = now;
  out(std::move(image));
}

Result<std::unique_ptr<LeptonFileCamera>> LeptonFileCamera::open(const std::string& folder,
                                                                 Executor& executor,
                                                                 Config config) {
  if (!(config.rate_hz > 0) || config.frames_per_still < 1) {
    return makeError(
        ErrorCode::InvalidInput,
        "thermal stills need a rate above 0 Hz and at least 1 frame each; got {} and {}",
        config.rate_hz, config.frames_per_still);
  }
  auto names = lepton::listStills(folder);
  if (!names) return tl::make_unexpected(names.error());
  auto player = std::make_shared<Player>();
  player->config = config;
  for (const std::string& name : *names) {
    const auto frame = lepton::readStill(name);
    if (!frame) return tl::make_unexpected(frame.error());
    player->images.push_back(lepton::toThermalImage(*frame));
    if (const std::string why = lepton::whyNoTemperatures(*frame); !why.empty())
      logger("driver.lepton")->warn("{}: shown only: {}", name, why);
    if (frame->pages > 1)
      logger("driver.lepton")
          ->warn("{}: has {} pages, the first is shown; save each as a file of its own", name,
                 frame->pages);
  }
  player->names = std::move(*names);
  executor.every(fromSeconds(1.0 / config.rate_hz), "io.thermal", kPriority,
                 [player](Stamp now) { player->tick(now); });
  return std::unique_ptr<LeptonFileCamera>(new LeptonFileCamera(std::move(player)));
}

LeptonFileCamera::LeptonFileCamera(std::shared_ptr<Player> player) : player_(std::move(player)) {}
LeptonFileCamera::~LeptonFileCamera() { stop(); }

Result<void> LeptonFileCamera::start(Sink<ThermalImagePtr> sink) {
  const std::lock_guard lock(player_->mutex);
  if (player_->sink)
    return makeError(ErrorCode::Refused, "the thermal camera is already running; stop it first");
  player_->sink = std::move(sink);
  return {};
}

void LeptonFileCamera::stop() {
  const std::lock_guard lock(player_->mutex);
  player_->sink = nullptr;
}

const std::vector<std::string>& LeptonFileCamera::stills() const { return player_->names; }

}  // namespace kiln
