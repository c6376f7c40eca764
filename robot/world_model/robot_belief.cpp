#include "robot/world_model/robot_belief.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kFarthest_m = 1e4;  // from the map's origin; no arena is larger

}  // namespace

void RobotBelief::continueClock(Stamp saved_at, Stamp now) {
  if (clock_started && now < saved_at) clock_start = now - (saved_at - clock_start);
}

json beliefToJson(const RobotBelief& belief) {
  json out{
      {"clock_started", belief.clock_started},
      {"clock_start_ns", toNanoseconds(belief.clock_start)},
      {"resets", belief.resets},
      {"X_map_base", {belief.X_map_base.x_m, belief.X_map_base.y_m, belief.X_map_base.yaw_rad}},
      {"pose_stamp_ns", toNanoseconds(belief.pose_stamp)}};
  if (belief.device_resets) out["device_resets"] = *belief.device_resets;
  return out;
}

// JSON writes NaN as null, which is then of the wrong type: a non-finite number cannot come back.
Result<RobotBelief> beliefFromJson(const json& j) {
  RobotBelief out;
  try {
    out.clock_started = j.at("clock_started").get<bool>();
    out.clock_start = stampFromNanoseconds(j.at("clock_start_ns").get<std::int64_t>());
    out.resets = j.at("resets").get<int>();
    const json& base = j.at("X_map_base");
    out.X_map_base = {base.at(0).get<double>(), base.at(1).get<double>(), base.at(2).get<double>()};
    out.pose_stamp = stampFromNanoseconds(j.at("pose_stamp_ns").get<std::int64_t>());
    if (j.contains("device_resets")) out.device_resets = j.at("device_resets").get<std::uint32_t>();
  } catch (const json::exception& e) {
    return makeError(ErrorCode::InvalidInput, "what the robot believes is damaged: {}", e.what());
  }
  if (std::hypot(out.X_map_base.x_m, out.X_map_base.y_m) > kFarthest_m)
    return makeError(ErrorCode::InvalidInput, "X_map_base lies {:.0f} m from the map's origin",
                     std::hypot(out.X_map_base.x_m, out.X_map_base.y_m));
  if (out.resets < 0)
    return makeError(ErrorCode::InvalidInput, "resets is {}, less than none", out.resets);
  return out;
}

}  // namespace kiln
