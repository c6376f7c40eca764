#include "robot/safety/command_gate.h"

#include <algorithm>
#include <cmath>

#include "robot/safety/dead_man.h"
#include "robot/safety/gate_rules.h"

namespace kiln {
namespace {

using gate::refuse;

constexpr double kMaxYaw_rad = 2.0 * M_PI;

GateDecision checkNumber(double value, double min, double max, std::string_view what,
                         std::string_view unit) {
  if (!std::isfinite(value))
    return refuse("not_finite", fmt::format("{} is {}; not obeyed", what, value));
  if (value < min || value > max) {
    return refuse("out_of_range", fmt::format("{} is {:.3g}{}{}; allowed {:.3g} to {:.3g}", what,
                                              value, unit.empty() ? "" : " ", unit, min, max));
  }
  return {};
}

GateDecision firstRefusal(std::initializer_list<GateDecision> decisions) {
  for (const GateDecision& decision : decisions) {
    if (!decision.accepted) return decision;
  }
  return {};
}

/// A command as the mission has described it: known, given to something, each argument once and in
/// its range.
GateDecision checkMissionCommand(const MissionCommand& command, const GateSituation& situation) {
  const CommandSpec* spec = situation.mission ? situation.mission->command(command.name) : nullptr;
  if (!spec)
    return refuse("no_such_command", fmt::format("this mission knows no '{}'", command.name));
  if (spec->target.empty() != command.target.empty())
    return refuse("bad_arguments", spec->target.empty()
                                       ? fmt::format("{} is given to nothing, not to '{}'",
                                                     spec->name, command.target)
                                       : fmt::format("{} needs a {}", spec->name, spec->target));
  if (command.arguments.size() != spec->arguments.size())
    return refuse("bad_arguments", fmt::format("{} takes {} arguments, {} were given", spec->name,
                                               spec->arguments.size(), command.arguments.size()));
  for (const ArgumentSpec& due : spec->arguments) {
    const auto given = std::find_if(command.arguments.begin(), command.arguments.end(),
                                    [&](const auto& a) { return a.name == due.name; });
    if (given == command.arguments.end())
      return refuse("bad_arguments", fmt::format("{} needs {}", spec->name, due.name));
    auto decision = checkNumber(given->value, due.low, due.high, due.name, due.unit);
    if (!decision.accepted) return decision;
  }
  return {};
}

}  // namespace

void CommandGate::Config::visit(ConfigArchive& a) {
  a.field("setpoint_age_s", setpoint_age_s, "s", 0.05, 0.3, "older setpoints are refused");
  a.field("discrete_age_s", discrete_age_s, "s", 0.1, 5.0, "older discrete commands are refused");
  a.field("transition_age_s", transition_age_s, "s", 0.1, 5.0,
          "older forced transitions are refused");
  a.field("future_tolerance_s", future_tolerance_s, "s", 0.0, 1.0,
          "stamps further ahead are refused");
  a.field("view_age_s", view_age_s, "s", 0.1, 5.0,
          "a jog needs a picture or cloud at most this old");
  a.field("rtt_amber_s", rtt_amber_s, "s", 0.01, 2.0,
          "round trip above which jogs are slowed to amber_scale");
  a.field("rtt_red_s", rtt_red_s, "s", 0.01, 2.0, "round trip above which jogs creep");
  a.field("rtt_refuse_s", rtt_refuse_s, "s", 0.01, 2.0, "round trip above which jogs are refused");
  a.field("amber_scale", amber_scale, "", 0.05, 1.0, "speed above rtt_amber_s");
  a.field("creep_scale", creep_scale, "", 0.05, 1.0, "speed above rtt_red_s");
  a.field("max_jog_speed_mps", max_jog_speed_mps, "m/s", 0.1, 4.0,
          "faster jogs are refused as errors");
  a.field("max_jog_rate_radps", max_jog_rate_radps, "rad/s", 0.1, 6.4,
          "faster turns are refused as errors");
  a.field("arena_reach_m", arena_reach_m, "m", 1.0, 1000.0,
          "no pose is set further from the origin of map");
}

GateDecision CommandGate::decide(const ReceivedCommand& received, const LeaseStatus& lease,
                                 const GateSituation& situation, Stamp now) {
  const CommandBody& body = received.command.body;
  if (auto decision = checkSender(received, lease); !decision.accepted) return decision;
  if (auto decision = checkFreshness(received, now); !decision.accepted) return decision;
  if (auto decision = checkValues(body, situation); !decision.accepted) return decision;
  if (isRelease(body)) return {};
  if (auto decision = gate::checkSituation(body, situation); !decision.accepted) return decision;
  if (std::holds_alternative<JogBase>(body) || std::holds_alternative<JogArm>(body)) {
    return checkJog(received, situation);
  }
  return {};
}

GateDecision CommandGate::checkSender(const ReceivedCommand& received,
                                      const LeaseStatus& lease) const {
  const Command& command = received.command;
  if (received.role == ClientRole::Viewer) {
    return refuse(
        "viewer",
        "this client said hello as a viewer: it may look and STOP; connect as an operator");
  }
  if (!gate::needsLease(command.body)) return {};
  if (lease.holder_client != command.client_id) {
    return refuse("no_lease",
                  lease.holder_client.empty()
                      ? "nobody has control; take it first"
                      : fmt::format("{} has control; ask for a take-over", lease.holder_name));
  }
  if (command.lease_epoch != lease.epoch) {
    return refuse("old_lease",
                  fmt::format("the command belongs to lease {}, the present one is {}; not obeyed",
                              command.lease_epoch, lease.epoch));
  }
  return {};
}

GateDecision CommandGate::checkFreshness(const ReceivedCommand& received, Stamp now) {
  const Command& command = received.command;
  const bool setpoint = isSetpoint(command.body);
  switch (replays_.check(command.client_id, command.nonce, setpoint, now)) {
    case ReplayFilter::Verdict::Fresh:
      break;
    case ReplayFilter::Verdict::Replayed:
      return refuse("replayed", fmt::format("command {} was received before; it is not done twice",
                                            command.nonce));
    case ReplayFilter::Verdict::OutOfOrder:
      return refuse("out_of_order",
                    fmt::format("setpoint {} was overtaken by a newer one", command.nonce));
    case ReplayFilter::Verdict::Implausible:
      return refuse("bad_number", fmt::format("command number {} lies too far ahead of the last; "
                                              "restart the client",
                                              command.nonce));
    case ReplayFilter::Verdict::TooMany:
      return refuse("too_many_clients", "too many clients come and go; try again in some seconds");
  }
  if (isRelease(command.body)) return {};
  const double limit_s = setpoint ? config_.setpoint_age_s
                         : std::holds_alternative<ChangeState>(command.body)
                             ? config_.transition_age_s
                             : config_.discrete_age_s;
  const double age_s = toSeconds(std::max(now, received.received) - command.issued);
  if (age_s > limit_s) {
    return refuse(
        "too_old",
        fmt::format("the command was {:.2f} s old when the robot got to it, {:.2f} s is the limit; "
                    "give it again",
                    age_s, limit_s));
  }
  if (toSeconds(command.issued - received.received) > config_.future_tolerance_s) {
    return refuse(
        "in_future",
        fmt::format("the command is stamped {:.2f} s ahead of the robot's clock; the station's "
                    "clock estimate is off: wait for it or reconnect",
                    toSeconds(command.issued - received.received)));
  }
  return {};
}

GateDecision CommandGate::checkValues(const CommandBody& body,
                                      const GateSituation& situation) const {
  const double v = config_.max_jog_speed_mps;
  const double w = config_.max_jog_rate_radps;
  if (const auto* jog = std::get_if<JogBase>(&body)) {
    return firstRefusal({checkNumber(jog->twist.vx_mps, -v, v, "forward speed", "m/s"),
                         checkNumber(jog->twist.vy_mps, -v, v, "sideways speed", "m/s"),
                         checkNumber(jog->twist.wz_radps, -w, w, "turn rate", "rad/s")});
  }
  if (const auto* jog = std::get_if<JogArm>(&body)) {
    for (int i = 0; i < 6; ++i) {
      const bool linear = jog->frame != JogFrame::Joint && i < 3;
      const double limit = linear ? v : w;
      auto decision =
          checkNumber(jog->velocity[i], -limit, limit, "arm jog", linear ? "m/s" : "rad/s");
      if (!decision.accepted) return decision;
    }
  }
  if (const auto* hold = std::get_if<HoldActuator>(&body); hold && !isRelease(body)) {
    const ActuatorSpec* spec =
        situation.mission ? situation.mission->actuator(hold->name) : nullptr;
    if (!spec) return refuse("no_such_actuator", fmt::format("the robot has no '{}'", hold->name));
    return checkNumber(hold->value, spec->low, spec->high, hold->name, "");
  }
  if (const auto* command = std::get_if<MissionCommand>(&body))
    return checkMissionCommand(*command, situation);
  if (const auto* pose = std::get_if<SetPose>(&body)) {
    const double reach = config_.arena_reach_m;
    return firstRefusal(
        {checkNumber(pose->X_map_base.x_m, -reach, reach, "x of the pose", "m"),
         checkNumber(pose->X_map_base.y_m, -reach, reach, "y of the pose", "m"),
         checkNumber(pose->X_map_base.yaw_rad, -kMaxYaw_rad, kMaxYaw_rad, "yaw", "rad")});
  }
  if (const auto* scale = std::get_if<SetSpeedScale>(&body)) {
    return checkNumber(scale->scale, 0.0, 1.0, "speed scale", "");
  }
  return {};
}

GateDecision CommandGate::checkJog(const ReceivedCommand& received,
                                   const GateSituation& situation) const {
  if (!(situation.view_age_s <= config_.view_age_s)) {
    return refuse(
        "stale_view",
        fmt::format("no camera picture or cloud younger than {:.1f} s reaches the operator; "
                    "jogging blind is refused: check the sensors and the link",
                    config_.view_age_s));
  }
  if (received.rtt_s > config_.rtt_refuse_s) {
    return refuse(
        "link_slow",
        fmt::format("the round trip is {:.0f} ms; above {:.0f} ms there is no jog, use macros or "
                    "transitions",
                    received.rtt_s * 1e3, config_.rtt_refuse_s * 1e3));
  }
  GateDecision decision;
  if (received.rtt_s > config_.rtt_red_s) {
    decision.speed_scale = config_.creep_scale;
  } else if (received.rtt_s > config_.rtt_amber_s) {
    decision.speed_scale = config_.amber_scale;
  }
  return decision;
}

}  // namespace kiln
