#include "robot/missions/common/checkpoint_keeper.h"

#include <algorithm>

namespace kiln {
namespace {

bool same(const std::vector<MissionHold>& a, const std::vector<MissionHold>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.reason == y.reason && x.text == y.text;
  });
}

}  // namespace

CheckpointKeeper::CheckpointKeeper(Config config, std::function<MissionCheckpoint()> take)
    : config_(std::move(config)),
      take_(std::move(take)),
      writer_(config_.path.empty() ? nullptr : std::make_unique<CheckpointWriter>(config_.path)) {
  if (writer_ && !config_.write)
    config_.write = [this](std::string text, bool durable) {
      writer_->write(std::move(text), durable);
    };
}

void CheckpointKeeper::save(Stamp now, bool durable) {
  last_save_ = now;
  if (!config_.write) return;
  MissionCheckpoint checkpoint = take_();
  checkpoint.stamp = now;
  saved_holds_ = checkpoint.holds;
  config_.write(encodeCheckpoint(checkpoint), durable);
}

void CheckpointKeeper::tick(const std::vector<MissionHold>& holds, Stamp now) {
  if (!same(holds, saved_holds_))
    save(now, true);
  else if (now - last_save_ >= fromSeconds(config_.period_s))
    save(now, false);
}

std::optional<Error> CheckpointKeeper::problem() const {
  return writer_ ? writer_->problem() : std::nullopt;
}

void CheckpointKeeper::flush() {
  if (writer_) writer_->flush();
}

}  // namespace kiln
