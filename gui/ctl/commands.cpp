#include "gui/ctl/commands.h"

#include <cstdio>

#include "gui/ctl/json_view.h"
#include "gui/ctl/signals.h"

namespace kiln::ctl {
namespace {
constexpr double kOptionalTopic_s = 1.0;  // a robot without mission publishes no state

constexpr double kStop_s = 5.0;
constexpr double kForever_s = 1e9;
}  // namespace

int showState(Console& console) {
  if (!console.connect()) return kNoLink;
  static_cast<void>(
      console.waitFor([&] { return console.session().link().rtt_s > 0.0; }, kOptionalTopic_s));
  for (int i = 0; i < 10 && !console.fsm() && !signalled(); ++i)
    console.pauseFor(kOptionalTopic_s / 10);
  const auto fsm = console.fsm();
  nlohmann::json out = toJson(console.status());
  if (fsm) out["mission"] = toJson(*fsm);
  out["link"] = toJson(console.session().link());
  console.print(out, oneLine(console.status(), fsm));
  return kDone;
}

int watch(Console& console, double period_s, double seconds) {
  if (!console.connect()) return kNoLink;
  const Stamp start = console.clock().now();
  while (!signalled() && (seconds <= 0.0 || toSeconds(console.clock().now() - start) < seconds)) {
    const auto fsm = console.fsm();
    const LinkReport link = console.session().link();
    nlohmann::json out = toJson(console.status());
    if (fsm) out["mission"] = toJson(*fsm);
    out["link"] = toJson(link);
    console.print(out, link.reason.empty()
                           ? oneLine(console.status(), fsm)
                           : fmt::format("{}: {}", toString(link.state), link.reason));
    console.pauseFor(period_s);
  }
  return kDone;
}

int showLocalization(Console& console) {
  if (!console.connect()) return kNoLink;
  if (!console.waitFor([&] { return console.localizationKnown(); }, kOptionalTopic_s))
    return console.fail(kRefused, "the robot does not tell where it is; does it localise?");
  const LocalizationStatus status = *console.localization();
  console.print(toJson(status), oneLine(status));
  return kDone;
}

int listMacros(Console& console) {
  if (!console.connect()) return kNoLink;
  for (int i = 0; i < 25 && console.macros().empty() && !signalled(); ++i)
    console.pauseFor(kLatched_s / 25);
  const auto macros = console.macros();
  if (macros.empty())
    return console.fail(kRefused, "the robot has no macros; look into its resources/macros");
  for (const MacroInfo& macro : macros) {
    console.print(toJson(macro),
                  fmt::format("{:<16} {:>4.0f} s  {:<12} {}; start: {}", macro.name,
                              macro.duration_s, macro.uses, macro.doc, macro.start_condition));
  }
  return kDone;
}

int showMission(Console& console) {
  if (!console.connect()) return kNoLink;
  const auto info = console.mission();
  if (!info) return console.fail(kRefused, "the robot does not tell of its mission");
  const RobotStatus status = console.status();
  std::string text = fmt::format("{}: {}\n", info->mission, info->title);
  for (const FigureSpec& spec : info->figures) {
    const Figure* figure = findFigure(status.figures, spec.id);
    text += fmt::format("  figure    {:<20} {:<12} {}\n", spec.id,
                        figure ? figureText(spec, figure->value) : "–",
                        spec.doc.empty() ? spec.label : spec.doc);
  }
  for (const CommandSpec& spec : info->commands) {
    text += fmt::format("  command   {:<20} {}{}\n", spec.name,
                        spec.target.empty() ? "" : "to a " + spec.target + ": ", spec.consequence);
    for (const ArgumentSpec& row : spec.arguments)
      text += fmt::format("            {:>20} {} to {} {}: {}\n", row.name, row.low, row.high,
                          row.unit, row.doc);
  }
  for (const ActuatorSpec& row : info->actuators)
    text += fmt::format("  actuator  {:<20} {} to {}: {}\n", row.name, row.low, row.high, row.text);
  text.pop_back();
  console.print(toJson(*info), text);
  return kDone;
}

int missionCommand(Console& console, const std::string& name, const std::string& target,
                   const std::vector<std::string>& arguments) {
  if (!console.connect()) return kNoLink;
  const auto info = console.mission();
  const CommandSpec* spec = info ? info->command(name) : nullptr;
  if (!spec)
    return console.fail(kRefused, fmt::format("the mission knows no command '{}'; see: kilnctl "
                                              "mission",
                                              name));
  MissionCommand command{name, target, {}};
  for (const ArgumentSpec& row : spec->arguments) command.arguments.push_back({row.name, 0.0});
  for (const std::string& text : arguments) {
    const std::size_t at = text.find('=');
    const auto given = std::find_if(
        command.arguments.begin(), command.arguments.end(),
        [&](const MissionCommand::Argument& a) { return a.name == text.substr(0, at); });
    char* end = nullptr;
    const char* number = at == std::string::npos ? "" : text.c_str() + at + 1;
    const double value = std::strtod(number, &end);
    if (given == command.arguments.end() || end == number || *end != '\0')
      return console.fail(kRefused, fmt::format("'{}' is no argument of {} with a number; see: "
                                                "kilnctl mission",
                                                text, name));
    given->value = value;
  }
  return commandWithControl(console, std::move(command));
}

int listAlarms(Console& console) {
  if (!console.connect()) return kNoLink;
  if (console.status().alarms.empty() && !console.options().json) std::puts("no alarms");
  for (const Alarm& alarm : console.status().alarms) {
    console.print(toJson(alarm),
                  fmt::format("{:<24} {}{}: {}", alarm.id, alarm.text,
                              alarm.acknowledged ? " (acknowledged)" : "", alarm.action));
  }
  return kDone;
}

int commandWithControl(Console& console, CommandBody body) {
  if (!console.connect()) return kNoLink;
  if (!console.takeControl()) return kRefused;
  const int code = console.run(std::move(body));
  console.giveControlBack();
  return code;
}

int clearStop(Console& console) {
  if (!console.connect()) return kNoLink;
  // The STOP that stands now: one that comes after it stays.
  return commandWithControl(console, ClearStop{console.status().stop.generation});
}

int transition(Console& console, const std::string& from, const std::string& to) {
  if (!console.connect()) return kNoLink;
  for (int i = 0; i < 10 && !console.fsm() && !signalled(); ++i)
    console.pauseFor(kOptionalTopic_s / 10);
  const auto fsm = console.fsm();
  if (!fsm)
    return console.fail(kRefused, "the robot publishes no mission; there is nothing to change");
  if (!from.empty() && from != fsm->state) {
    return console.fail(
        kRefused,
        fmt::format("the mission is in {}, not in {}; nothing was sent", fsm->state, from),
        "moved");
  }
  if (!console.takeControl()) return kRefused;
  // State and step as seen above: if the mission moves on meanwhile, the robot refuses.
  const int code = console.run(ChangeState{fsm->state, fsm->step, to});
  console.giveControlBack();
  return code;
}

int keepControl(Console& console, double seconds) {
  if (!console.connect()) return kNoLink;
  if (!console.takeControl()) return kRefused;
  const auto epoch = console.session().lease().epoch;
  console.print({{"outcome", "done"}, {"command", "acquire_lease"}, {"epoch", epoch}},
                fmt::format("in control (lease {}); end with Ctrl-C", epoch));
  const bool taken = console.waitFor([&] { return !console.session().lease().mine; },
                                     seconds > 0.0 ? seconds : kForever_s);
  if (taken) return console.fail(kRefused, "control was lost", "lease_lost");
  console.giveControlBack();
  return kDone;
}

int stopRobot(Console& console) {
  if (!console.open()) return kNoLink;
  // No waiting for hello, clock or lease: the first request leaves with the connection.
  console.session().stop();
  const auto latched = [&] {
    return console.session().stopReport().state == StopReport::State::Latched;
  };
  if (!console.waitFor(latched, kStop_s)) {
    return console.fail(kNoLink, fmt::format("{}: STOP was not acknowledged; use the hardware stop",
                                             console.options().endpoint));
  }
  const StopReport report = console.session().stopReport();
  console.print(
      {{"outcome", "latched"},
       {"command", "stop"},
       {"round_trip_s", report.round_trip_s},
       {"repetitions", report.repetitions}},
      fmt::format("STOP latched, acknowledged after {:.1f} ms", report.round_trip_s * 1e3));
  return kDone;
}

}  // namespace kiln::ctl
