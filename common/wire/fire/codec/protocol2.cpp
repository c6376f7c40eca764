#include "common/wire/fire/codec/protocol2.h"

#include <cmath>

#include <fmt/format.h>

#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "common/wire/fsm.h"
#include "common/wire/geometry.h"
#include "common/wire/mission.h"
#include "common/wire/proto_message.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"
#include "kiln/fire/v1/protocol2.pb.h"

namespace kiln::wire::protocol2 {
namespace {

constexpr std::size_t kMaxBytes = 1u << 20;
constexpr double kMaxNudge_m = 0.5, kMaxNudge_deg = 30.0;  // of the command gate at that time

Result<WaterLevels> waterOf(const fire::v1::WaterStatus& in) {
  WaterLevels water;
  if (auto ok = copyFixed(in.duty(), water.duty, "pump duty"); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = copyFixed(in.current_a(), water.current_a, "pump current"); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = copyFixed(in.tank_l_est(), water.tank_l_est, "tanks"); !ok)
    return tl::make_unexpected(ok.error());
  water.sprayed_l_est = in.sprayed_l_est();
  return water;
}

}  // namespace

Result<std::string> upgradeStatus(std::string_view bytes) {
  auto status = decodeRobotStatus(bytes);
  if (!status) return tl::make_unexpected(status.error());
  const auto old = parse<fire::v1::RobotStatusProtocol2>(bytes, kMaxBytes, "robot status");
  if (!old) return tl::make_unexpected(old.error());
  if (old->has_water()) {
    const auto water = waterOf(old->water());
    if (!water) return tl::make_unexpected(water.error());
    status->figures = kiln::fire::figures(*water, old->score_est(), std::nan(""));
  }
  return encode(*status);
}

Result<std::string> upgradeScene(std::string_view bytes) {
  auto scene = decodeScene(bytes);
  if (!scene) return tl::make_unexpected(scene.error());
  const auto site = decodeFireSite(bytes);
  if (!site) return tl::make_unexpected(site.error());
  scene->items = kiln::fire::sceneItems(*site);
  scene->detail = encodeDetail(*site);
  return encode(*scene);
}

Result<std::string> upgradeMacros(std::string_view bytes) {
  auto macros = decodeMacros(bytes);
  if (!macros) return tl::make_unexpected(macros.error());
  const auto old = parse<fire::v1::MacroListProtocol2>(bytes, kMaxBytes, "macro list");
  if (!old) return tl::make_unexpected(old.error());
  for (int i = 0; i < old->macros_size(); ++i) {
    if (old->macros(i).water_l() > 0.0)
      (*macros)[static_cast<std::size_t>(i)].uses =
          fmt::format("est. {:.1f} l", old->macros(i).water_l());
  }
  return encode(*macros);
}

Result<std::string> upgradeHeat(std::string_view bytes) {
  const auto heat = decodeHeat(bytes);
  if (!heat) return tl::make_unexpected(heat.error());
  return encode(encodeDetail(*heat));
}

Result<std::string> missionInfo(std::string_view fsm_info) {
  const auto fsm = decodeFsmInfo(fsm_info);
  if (!fsm) return tl::make_unexpected(fsm.error());
  MissionInfo info;
  if (fsm->mission.find("fire") != std::string::npos)
    info = kiln::fire::missionInfo(kMaxNudge_m, kMaxNudge_deg);
  info.mission = fsm->mission;
  info.mission_uuid = fsm->mission_uuid;
  return encode(info);
}

}  // namespace kiln::wire::protocol2
