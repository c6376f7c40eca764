#include "robot/app/robot_mission.h"

#include <algorithm>
#include <iterator>

#include <fmt/ranges.h>

#include "common/core/log.h"
#include "robot/app/teleop.h"

namespace kiln {

std::string RobotMission::checkpointPath() const {
  const RobotOptions& options = body_.options;
  return options.state_dir.empty() ? std::string()
                                   : options.state_dir + "/" + options.mission + ".checkpoint";
}

Result<void> RobotMission::make(const MissionParts& parts) {
  const RobotOptions& options = body_.options;
  const MissionKind* kind = findMission(options.mission);
  if (kind == nullptr)
    return makeError(ErrorCode::InvalidInput, "there is no mission '{}'; known: {}",
                     options.mission, fmt::join(missionNames(), ", "));
  const DeviceSet present = body_.devices.present();
  std::set_difference(kind->needs.begin(), kind->needs.end(), present.begin(), present.end(),
                      std::inserter(lacking_, lacking_.end()));
  auto made = kind->make(*body_.settings.missions.find(kind->name), options.mission_uuid, parts);
  if (!made) return tl::make_unexpected(made.error());
  mission_ = std::move(*made);
  info_ = mission_->info();
  info_.mission = kind->name;
  info_.mission_uuid = options.mission_uuid;
  if (body_.devices.pumps != nullptr) info_.actuators = Teleop::actuators();
  host_ = std::make_unique<MissionHost>(
      *mission_, body_.belief, body_.stop, body_.clock,
      CheckpointKeeper::Config{checkpointPath(), body_.settings.checkpoint_period_s});
  return {};
}

Result<void> RobotMission::resume() {
  const std::string path = checkpointPath();
  const auto saved = loadCheckpoint(path);
  if (!saved) return tl::make_unexpected(saved.error());
  auto restored = host_->restore(*saved, body_.clock.now());
  if (!restored)
    return makeError(restored.error().code, "{}: {}; start without --resume", path,
                     restored.error().message);
  return {};
}

bool RobotMission::takeBegun() {
  if (host_->starts() == starts_seen_) return false;
  starts_seen_ = host_->starts();
  return true;
}

void RobotMission::beginReport() {
  report_.begin();
  ended_.store(false);
  succeeded_.store(false);
}

void RobotMission::update() {
  const FsmStatus& fsm = host_->fsm();
  if (!fsm.terminal || ended_.load()) return;
  succeeded_.store(fsm.success);
  ended_.store(true);
  logger("mission")->info("mission ended: {}", fsm.success ? "success" : fsm.display_text);
}

}  // namespace kiln
