#include "robot/missions/common/mission_checkpoint.h"

#include <nlohmann/json.hpp>

#include "robot/world_model/read_file.h"
#include "robot/world_model/world_json.h"

namespace kiln {
namespace {
using nlohmann::json;
constexpr const char* kFormat = "kiln-mission-checkpoint";

FsmCheckpoint fsmFrom(const json& j) {
  return {j.at("mission").get<std::string>(), j.at("mission_uuid").get<std::string>(),
          j.at("step").get<std::uint64_t>(), j.at("state").get<std::string>(),
          j.at("resume_state").get<std::string>()};
}

json holdsToJson(const std::vector<MissionHold>& holds) {
  json out = json::array();
  for (const MissionHold& hold : holds)
    out.push_back({{"reason", static_cast<int>(hold.reason)}, {"text", hold.text}});
  return out;
}

/// A file of before has no such list: its mission ran.
Result<std::vector<MissionHold>> holdsFrom(const json& rows, const std::string& name) {
  std::vector<MissionHold> out;
  for (const json& row : rows) {
    const int reason = row.at("reason").get<int>();
    if (reason < 0 || reason > static_cast<int>(HoldReason::Restored))
      return makeError(ErrorCode::InvalidInput,
                       "{}: the checkpoint is damaged: hold reason {} is unknown; start without "
                       "--resume",
                       name, reason);
    out.push_back({static_cast<HoldReason>(reason), row.at("text").get<std::string>()});
  }
  return out;
}

}  // namespace

std::string encodeCheckpoint(const MissionCheckpoint& checkpoint) {
  const FsmCheckpoint& fsm = checkpoint.fsm;
  const json out = {{"format", kFormat},
                    {"version", MissionCheckpoint::kVersion},
                    {"stamp_ns", toNanoseconds(checkpoint.stamp)},
                    {"fsm",
                     {{"mission", fsm.mission},
                      {"mission_uuid", fsm.mission_uuid},
                      {"step", fsm.step},
                      {"state", fsm.state},
                      {"resume_state", fsm.resume_state}}},
                    {"holds", holdsToJson(checkpoint.holds)},
                    {"world", worldToJson(checkpoint.world)}};
  return out.dump(1) + "\n";
}

Result<MissionCheckpoint> decodeCheckpoint(const std::string& text, const std::string& name) {
  const json j = json::parse(text, nullptr, false);
  if (j.is_discarded() || !j.is_object())
    return makeError(ErrorCode::Truncated,
                     "{}: the checkpoint is cut off or damaged; start without --resume", name);
  if (j.value("format", json()) != kFormat ||
      j.value("version", json()) != MissionCheckpoint::kVersion)
    return makeError(ErrorCode::VersionMismatch,
                     "{}: this is not a checkpoint of version {} but format {} version {}; start "
                     "without --resume",
                     name, MissionCheckpoint::kVersion, j.value("format", json()).dump(),
                     j.value("version", json()).dump());
  MissionCheckpoint out;
  try {
    out.stamp = stampFromNanoseconds(j.at("stamp_ns").get<std::int64_t>());
    out.fsm = fsmFrom(j.at("fsm"));
    auto world = worldFromJson(j.at("world"));
    if (!world)
      return tl::make_unexpected(Error{world.error().code, name + ": " + world.error().message});
    out.world = std::move(*world);
    auto holds = holdsFrom(j.value("holds", json::array()), name);
    if (!holds) return tl::make_unexpected(holds.error());
    out.holds = std::move(*holds);
  } catch (const json::exception& e) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: the checkpoint is damaged: {}; start without --resume", name, e.what());
  }
  return out;
}

Result<MissionCheckpoint> loadCheckpoint(const std::string& path) {
  const auto text = readWholeFile(path);
  if (!text) return tl::make_unexpected(text.error());
  return decodeCheckpoint(*text, path);
}

}  // namespace kiln
