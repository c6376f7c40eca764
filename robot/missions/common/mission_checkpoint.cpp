#include "robot/missions/common/mission_checkpoint.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "common/core/regular_file.h"

namespace kiln {
namespace {
using nlohmann::json;
constexpr const char* kFormat = "kiln-mission-checkpoint";
constexpr std::uint64_t kMostBytes = 16U << 20;

/// Objects are kept sorted and numbers are printed to come back as they were: what was read dumps
/// to the text that was written.
std::uint32_t checksum(const json& body) {
  const std::string text = body.dump();
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

tl::unexpected<Error> damaged(const std::string& name, const std::string& why) {
  return makeError(ErrorCode::InvalidInput,
                   "{}: the checkpoint is damaged: {}; start without --resume", name, why);
}

FsmCheckpoint fsmFrom(const json& j) {
  return {j.at("mission").get<std::string>(),      j.at("mission_uuid").get<std::string>(),
          j.at("step").get<std::uint64_t>(),       j.at("state").get<std::string>(),
          j.at("resume_state").get<std::string>(), j.value("arrived", true)};
}

json holdsToJson(const std::vector<MissionHold>& holds) {
  json out = json::array();
  for (const MissionHold& hold : holds)
    out.push_back({{"reason", static_cast<int>(hold.reason)}, {"text", hold.text}});
  return out;
}

Result<std::vector<MissionHold>> holdsFrom(const json& rows) {
  std::vector<MissionHold> out;
  for (const json& row : rows) {
    const int reason = row.at("reason").get<int>();
    if (reason < 0 || reason > static_cast<int>(HoldReason::Restored))
      return makeError(ErrorCode::InvalidInput, "hold reason {} is unknown", reason);
    out.push_back({static_cast<HoldReason>(reason), row.at("text").get<std::string>()});
  }
  return out;
}

Result<MissionCheckpoint> checkpointFrom(const json& body) {
  MissionCheckpoint out;
  out.stamp = stampFromNanoseconds(body.at("stamp_ns").get<std::int64_t>());
  out.fsm = fsmFrom(body.at("fsm"));
  auto holds = holdsFrom(body.at("holds"));
  if (!holds) return tl::make_unexpected(holds.error());
  out.holds = std::move(*holds);
  auto robot = beliefFromJson(body.at("robot"));
  if (!robot) return tl::make_unexpected(robot.error());
  out.robot = *robot;
  out.log = std::make_shared<const json>(body.at("log"));
  out.mission = std::make_shared<const json>(body.at("mission"));
  return out;
}

}  // namespace

std::string encodeCheckpoint(const MissionCheckpoint& checkpoint) {
  const FsmCheckpoint& fsm = checkpoint.fsm;
  const json body = {{"stamp_ns", toNanoseconds(checkpoint.stamp)},
                     {"fsm",
                      {{"mission", fsm.mission},
                       {"mission_uuid", fsm.mission_uuid},
                       {"step", fsm.step},
                       {"state", fsm.state},
                       {"resume_state", fsm.resume_state},
                       {"arrived", fsm.arrived}}},
                     {"holds", holdsToJson(checkpoint.holds)},
                     {"robot", beliefToJson(checkpoint.robot)},
                     {"log", checkpoint.log ? *checkpoint.log : json()},
                     {"mission", checkpoint.mission ? *checkpoint.mission : json()}};
  const json out = {{"format", kFormat},
                    {"version", MissionCheckpoint::kVersion},
                    {"crc32", checksum(body)},
                    {"body", body}};
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
  const json body = j.value("body", json());
  if (j.value("crc32", json()) != checksum(body))
    return damaged(name, "its checksum does not fit what it says");
  try {
    auto read = checkpointFrom(body);
    if (!read) return damaged(name, read.error().message);
    return read;
  } catch (const json::exception& e) {
    return damaged(name, e.what());
  }
}

Result<MissionCheckpoint> loadCheckpoint(const std::string& path) {
  const auto text = readRegularFile(path, kMostBytes);
  if (!text) return tl::make_unexpected(text.error());
  return decodeCheckpoint(*text, path);
}

}  // namespace kiln
