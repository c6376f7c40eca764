#include "gui/ctl/json_view.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln::ctl {
namespace {

using nlohmann::json;

const char* alarmLevel(AlarmLevel level) {
  switch (level) {
    case AlarmLevel::Advisory:
      return "advisory";
    case AlarmLevel::Caution:
      return "caution";
    case AlarmLevel::Warning:
      return "warning";
  }
  return "?";
}

const char* environmentName(Environment environment) {
  switch (environment) {
    case Environment::Live:
      return "live";
    case Environment::Sim:
      return "sim";
    case Environment::Replay:
      return "replay";
  }
  return "?";
}

json listsOf(const RobotStatus& status) {
  json lists;
  for (const Check& check : status.checks) {
    lists["checks"].push_back({{"name", check.name},
                               {"ok", check.ok},
                               {"detail", check.detail},
                               {"action", check.action},
                               {"warn", check.warn}});
  }
  for (const Alarm& alarm : status.alarms) lists["alarms"].push_back(toJson(alarm));
  for (const DropCount& drop : status.drops) lists["drops"][drop.topic] = drop.dropped;
  lists["operators"] = status.operators;
  return lists;
}

}  // namespace

std::string modeName(Mode mode) { return std::string(toString(mode)); }

json toJson(const Alarm& alarm) {
  return {{"id", alarm.id},
          {"level", alarmLevel(alarm.level)},
          {"text", alarm.text},
          {"action", alarm.action},
          {"since_s", toSeconds(alarm.since)},
          {"active", alarm.active},
          {"acknowledged", alarm.acknowledged}};
}

json toJson(const MacroInfo& macro) {
  return {{"name", macro.name},
          {"doc", macro.doc},
          {"duration_s", macro.duration_s},
          {"uses", macro.uses},
          {"start_condition", macro.start_condition}};
}

json toJson(const MissionInfo& info) {
  json out = {{"mission", info.mission},   {"mission_uuid", info.mission_uuid},
              {"title", info.title},       {"panels", info.panels},
              {"figures", json::array()},  {"commands", json::array()},
              {"actuators", json::array()}};
  for (const FigureSpec& spec : info.figures)
    out["figures"].push_back({{"id", spec.id},
                              {"label", spec.label},
                              {"unit", spec.unit},
                              {"estimated", spec.estimated},
                              {"doc", spec.doc}});
  for (const CommandSpec& spec : info.commands) {
    json arguments = json::array();
    for (const ArgumentSpec& row : spec.arguments)
      arguments.push_back(
          {{"name", row.name}, {"unit", row.unit}, {"low", row.low}, {"high", row.high}});
    out["commands"].push_back({{"name", spec.name},
                               {"target", spec.target},
                               {"consequence", spec.consequence},
                               {"arguments", arguments}});
  }
  for (const ActuatorSpec& row : info.actuators)
    out["actuators"].push_back({{"name", row.name}, {"low", row.low}, {"high", row.high}});
  return out;
}

json toJson(const CommandUpdate& update) {
  return {{"command", update.command},     {"outcome", std::string(toString(update.state))},
          {"code", update.code},           {"reason", update.reason},
          {"holder", update.lease_holder}, {"answered_after_s", update.answered_after_s}};
}

json toJson(const LinkReport& link) {
  json drops = json::object();
  for (const DropCount& drop : link.drops) drops[drop.topic] = drop.dropped;
  return {{"state", std::string(toString(link.state))},
          {"reason", link.reason},
          {"rtt_ms", link.rtt_s * 1e3},
          {"rtt_p95_ms", link.rtt_p95_s * 1e3},
          {"rx_age_s", link.rx_age_s},
          {"robot_rx_age_s", link.robot_rx_age_s},
          {"clock_offset_s", link.clock_offset_s},
          {"clock_uncertainty_s", link.clock_uncertainty_s},
          {"clock_drift_ppm", link.clock_drift_ppm},
          {"drops", drops}};
}

json toJson(const FsmStatus& status) {
  json guards = json::array();
  for (const GuardStatus& guard : status.guards) {
    guards.push_back({{"name", guard.name},
                      {"met", guard.met},
                      {"detail", guard.detail},
                      {"input_age_s", guard.input_age_s}});
  }
  return {{"mission_uuid", status.mission_uuid},
          {"state", status.state},
          {"step", status.step},
          {"time_in_state_s", toSeconds(timeInState(status))},
          {"paused_in_state_s", toSeconds(status.paused_in_state.value_or(Duration{}))},
          {"running", status.running},
          {"paused", status.paused},
          {"terminal", status.terminal},
          {"success", status.success},
          {"text", status.display_text},
          {"blocked", status.blocked},
          {"guards", guards}};
}

json toJson(const RobotStatus& status) {
  json out = listsOf(status);
  const auto& arm = status.arm;
  out.update(json{{"robot", status.robot_name},
                  {"version", status.version},
                  {"environment", environmentName(status.environment)},
                  {"stamp_s", toSeconds(status.stamp)},
                  {"mode", modeName(status.mode)},
                  {"word", std::string(toString(status.word))},
                  {"reason", status.reason},
                  {"lease",
                   {{"holder", status.lease.holder_name},
                    {"epoch", status.lease.epoch},
                    {"expires_in_s", status.lease.expires_in_s},
                    {"requested_by", status.lease.requested_by_name}}},
                  {"stop",
                   {{"latched", status.stop.latched},
                    {"source", status.stop.source},
                    {"standstill_proven", status.stop.standstill_proven}}},
                  {"pose",
                   {{"x_m", status.X_map_base.x_m},
                    {"y_m", status.X_map_base.y_m},
                    {"yaw_deg", status.X_map_base.yaw_rad / kDeg},
                    {"age_s", status.pose_age_s}}},
                  {"twist", {status.twist.vx_mps, status.twist.vy_mps, status.twist.wz_radps}},
                  {"arm",
                   {{"q_rad", std::vector<double>(arm.q.data(), arm.q.data() + arm.q.size())},
                    {"safety", std::string(toString(arm.safety))},
                    {"powered", arm.powered}}},
                  {"macro",
                   {{"running", status.macro.running},
                    {"step", status.macro.step},
                    {"steps", status.macro.steps},
                    {"text", status.macro.step_text},
                    {"progress", status.macro.progress},
                    {"last_result", status.macro.last_result}}},
                  {"battery", {{"voltage_v", status.battery_v}, {"current_a", status.battery_a}}},
                  {"speed_scale", status.speed_scale},
                  {"mission_elapsed_s", status.mission_elapsed_s},
                  {"mission_limit_s", status.mission_limit_s},
                  {"resets", status.resets}});
  for (const Figure& figure : status.figures) out["figures"][figure.id] = figure.value;
  out["recording"] = {{"on", status.recording.on},
                      {"file", status.recording.file},
                      {"duration_s", status.recording.duration_s},
                      {"bytes", status.recording.bytes},
                      {"dropped", status.recording.dropped},
                      {"problem", status.recording.problem}};
  return out;
}

std::string oneLine(const RobotStatus& status, const std::optional<FsmStatus>& fsm) {
  return fmt::format("{}  {}  lease {}  {}pose {:.2f} {:.2f} m {:.0f} deg{}", toString(status.word),
                     fsm ? fmt::format("{} (step {})", fsm->state, fsm->step) : "no mission",
                     status.lease.holder_name.empty() ? "free" : status.lease.holder_name,
                     status.stop.latched ? fmt::format("STOP by {}  ", status.stop.source) : "",
                     status.X_map_base.x_m, status.X_map_base.y_m, status.X_map_base.yaw_rad / kDeg,
                     status.reason.empty() ? "" : "  " + status.reason);
}

json toJson(const LocalizationStatus& status) {
  const Pose2 pose = projectToGround(status.X_map_base);
  json out{{"health", std::string(toString(status.health))},
           {"reason", status.reason},
           {"method", status.method},
           {"submap", status.submap},
           {"x_m", pose.x_m},
           {"y_m", pose.y_m},
           {"z_m", status.X_map_base.translation().z()},
           {"yaw_deg", pose.yaw_rad / kDeg},
           {"sigma_m", status.sigma_m},
           {"sigma_yaw_deg", status.sigma_yaw_rad / kDeg},
           {"match_age_s", status.match_age_s},
           {"inlier_fraction", status.inlier_fraction},
           {"observable_directions", status.observable_directions},
           {"matches", status.matches},
           {"rejected", status.rejected},
           {"resets", status.resets}};
  if (status.tracking_error_m) out["tracking_error_m"] = *status.tracking_error_m;
  return out;
}

std::string oneLine(const LocalizationStatus& status) {
  const Pose2 pose = projectToGround(status.X_map_base);
  return fmt::format("{}  {:.3f} m {:.2f} deg  pose {:.2f} {:.2f} m {:.1f} deg  {} {}  {}{}",
                     toString(status.health), status.sigma_m, status.sigma_yaw_rad / kDeg, pose.x_m,
                     pose.y_m, pose.yaw_rad / kDeg, status.method, status.submap,
                     status.match_age_s < 0.0
                         ? "never matched"
                         : fmt::format("matched {:.1f} s ago", status.match_age_s),
                     status.reason.empty() ? "" : "  " + status.reason);
}

}  // namespace kiln::ctl
