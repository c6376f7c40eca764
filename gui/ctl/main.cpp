#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <unistd.h>

#include "common/config/command_line.h"
#include "common/config/config_archive.h"
#include "common/core/log.h"
#include "common/core/units.h"
#include "gui/ctl/commands.h"
#include "gui/ctl/signals.h"

namespace {

using kiln::CommandBody;
using kiln::ctl::Console;

/// What the command line asks for; filled by CLI11, then run once.
struct Request {
  Console::Options options;
  std::function<int(Console&)> run;
  // Arguments of the subcommands.
  std::string from_or_to, to, mode, name, alarm, frame = "base", record;
  std::array<double, 3> base{};
  std::vector<double> arm;
  std::vector<std::string> arguments;
  double seconds = 0.0, period_s = 0.5, scale = 0.35;
  bool restart = false;
};

constexpr int kFailed = 1;
const CLI::Validator kFinite = kiln::within(-1e6, 1e6);
const CLI::Validator kForSeconds = kiln::within(0.0, 1e6);

std::string defaultName() {
  const char* user = std::getenv("USER");
  return fmt::format("kilnctl {}", user != nullptr ? user : "operator");
}

void addThree(CLI::App& app, std::array<double, 3>& values, const std::array<const char*, 3>& names,
              const std::array<const char*, 3>& units) {
  for (std::size_t i = 0; i < 3; ++i)
    app.add_option(names[i], values[i], units[i])->required()->check(kFinite);
}

void addSimple(CLI::App& app, Request& request, const char* name, const char* doc,
               CommandBody body) {
  app.add_subcommand(name, doc)->callback([&request, body = std::move(body)] {
    request.run = [body](Console& console) { return kiln::ctl::commandWithControl(console, body); };
  });
}

void addViews(CLI::App& app, Request& request) {
  app.add_subcommand("state", "print the robot's state once")->callback([&request] {
    request.options.role = kiln::ClientRole::Viewer;
    request.run = kiln::ctl::showState;
  });
  CLI::App* watch = app.add_subcommand("watch", "print the state again and again");
  watch->add_option("--period", request.period_s, "seconds between lines")
      ->check(kiln::within(0.05, 60.0));
  watch->add_option("--seconds", request.seconds, "end after this; 0: Ctrl-C ends it")
      ->check(kForSeconds);
  watch->callback([&request] {
    request.options.role = kiln::ClientRole::Viewer;
    request.run = [&request](Console& console) {
      return kiln::ctl::watch(console, request.period_s, request.seconds);
    };
  });
}

void addMission(CLI::App& app, Request& request) {
  addSimple(app, request, "start", "start the mission", kiln::StartMission{});
  addSimple(app, request, "pause", "pause the mission", kiln::Pause{});
  addSimple(app, request, "resume", "go on with the mission", kiln::Resume{});
  addSimple(app, request, "reset", "competition reset: the robot is carried back to its start",
            kiln::ResetRobot{});
  app.add_subcommand("clear-stop", "clear a latched STOP; moves nothing")->callback([&request] {
    request.run = kiln::ctl::clearStop;
  });
  addSimple(app, request, "release-protective-stop",
            "release the arm's protective stop, after looking", kiln::ReleaseProtectiveStop{});
  CLI::App* transition = app.add_subcommand("transition", "force a transition");
  transition
      ->add_option("FROM_OR_TO", request.from_or_to, "state to enter, or to leave if two are given")
      ->required();
  transition->add_option("TO", request.to, "state to enter");
  transition->callback([&request] {
    request.run = [&request](Console& console) {
      return request.to.empty() ? kiln::ctl::transition(console, "", request.from_or_to)
                                : kiln::ctl::transition(console, request.from_or_to, request.to);
    };
  });
  CLI::App* mode = app.add_subcommand("mode", "autonomous or teleop");
  mode->add_option("MODE", request.mode)
      ->required()
      ->check(CLI::IsMember({"autonomous", "teleop"}));
  mode->callback([&request] {
    const auto wanted = request.mode == "teleop" ? kiln::Mode::Teleop : kiln::Mode::Autonomous;
    request.run = [wanted](Console& console) {
      return kiln::ctl::commandWithControl(console, kiln::SetMode{wanted});
    };
  });
}

void addPlaces(CLI::App& app, Request& request) {
  app.add_subcommand("localization", "where the robot believes to be, and how sure it is")
      ->callback([&request] {
        request.options.role = kiln::ClientRole::Viewer;
        request.run = kiln::ctl::showLocalization;
      });
  CLI::App* pose = app.add_subcommand("pose", "tell the robot where it stands, in map");
  addThree(*pose, request.base, {"X", "Y", "YAW_DEG"}, {"m", "m", "degrees"});
  pose->callback([&request] {
    request.run = [&request](Console& console) {
      const auto& [x, y, yaw_deg] = request.base;
      return kiln::ctl::commandWithControl(console, kiln::SetPose{{x, y, yaw_deg * kiln::kDeg}});
    };
  });
  app.add_subcommand("mission", "what the mission brings: figures, commands, actuators")
      ->callback([&request] {
        request.options.role = kiln::ClientRole::Viewer;
        request.run = kiln::ctl::showMission;
      });
  CLI::App* command = app.add_subcommand(
      "do", "do NAME [TARGET] [--set KEY=NUMBER ...]: a command of the mission (see: mission)");
  command->add_option("NAME", request.name, "\"nudge_place\"")->required();
  command->add_option("TARGET", request.to, "what it is given to: \"place 1\"");
  command->add_option("--set", request.arguments, "an argument; those left out are 0");
  command->callback([&request] {
    request.run = [&request](Console& console) {
      return kiln::ctl::missionCommand(console, request.name, request.to, request.arguments);
    };
  });
}

void addLeaseAndStop(CLI::App& app, Request& request) {
  CLI::App* lease =
      app.add_subcommand("lease", "acquire, take-over (asks the holder) or release control");
  lease->require_subcommand(1);
  for (const bool take_over : {false, true}) {
    CLI::App* acquire =
        lease->add_subcommand(take_over ? "take-over" : "acquire", "take control and keep it");
    acquire->add_option("--seconds", request.seconds, "keep it this long; 0: until Ctrl-C")
        ->check(kForSeconds);
    acquire->callback([&request, take_over] {
      request.options.take_over = take_over;
      request.run = [&request](Console& console) {
        return kiln::ctl::keepControl(console, request.seconds);
      };
    });
  }
  lease->add_subcommand("release", "give control back (of this very process, so: says who has it)")
      ->callback([&request] {
        request.run = [](Console& console) {
          return console.connect() ? console.run(kiln::ReleaseLease{}) : kiln::ctl::kNoLink;
        };
      });
  app.add_subcommand("stop", "STOP (software): latches, needs no control")->callback([&request] {
    request.run = kiln::ctl::stopRobot;
  });
  CLI::App* record =
      app.add_subcommand("record", "record on | off: the robot's recorder; needs no control");
  record->add_option("SWITCH", request.record)->required()->check(CLI::IsMember({"on", "off"}));
  record->callback([&request] {
    request.run = [&request](Console& console) {
      return console.connect() ? console.run(kiln::SetRecording{request.record == "on"})
                               : kiln::ctl::kNoLink;
    };
  });
  CLI::App* alarms = app.add_subcommand("alarms", "list alarms, or acknowledge one");
  alarms->add_option("--ack", request.alarm, "id of the alarm to acknowledge");
  alarms->callback([&request] {
    request.run = [&request](Console& console) {
      if (request.alarm.empty()) return kiln::ctl::listAlarms(console);
      return console.connect() ? console.run(kiln::AcknowledgeAlarm{request.alarm})
                               : kiln::ctl::kNoLink;
    };
  });
}

void addHolds(CLI::App& app, Request& request) {
  const auto hold = [&request](CommandBody body) {
    request.run = [&request, body = std::move(body)](Console& console) {
      return kiln::ctl::holdSetpoint(console, body, request.seconds);
    };
  };
  CLI::App* jog = app.add_subcommand(
      "jog", "move by hand while this runs (mode teleop); shows no view: keep the robot in sight");
  jog->require_subcommand(1);
  CLI::App* base = jog->add_subcommand("base", "drive at this speed, in base");
  addThree(*base, request.base, {"VX", "VY", "WZ"}, {"m/s", "m/s", "rad/s"});
  base->add_option("--seconds", request.seconds, "release after this; 0: a signal releases")
      ->check(kForSeconds);
  base->callback([&request, hold] {
    hold(kiln::JogBase{{request.base[0], request.base[1], request.base[2]}});
  });
  CLI::App* arm = jog->add_subcommand("arm", "move the arm at these six speeds");
  arm->add_option("V1 .. V6", request.arm, "rad/s of each joint; else three m/s and three rad/s")
      ->required()
      ->expected(6)
      ->check(kFinite);
  arm->add_option("--frame", request.frame)->check(CLI::IsMember({"joint", "tool", "base"}));
  arm->add_option("--seconds", request.seconds, "release after this; 0: a signal releases")
      ->check(kForSeconds);
  arm->callback([&request, hold] {
    kiln::JogArm body;
    body.frame = request.frame == "joint"  ? kiln::JogFrame::Joint
                 : request.frame == "tool" ? kiln::JogFrame::Tool
                                           : kiln::JogFrame::Base;
    body.velocity = Eigen::Map<const kiln::Vector6d>(request.arm.data());
    hold(body);
  });
  CLI::App* actuator = app.add_subcommand(
      "hold", "hold ACTUATOR VALUE: run it while this runs (mode teleop; names: mission)");
  actuator->add_option("ACTUATOR", request.name, "\"pumps\"")->required();
  actuator->add_option("VALUE", request.scale)->required()->check(kFinite);
  actuator->add_option("--seconds", request.seconds, "release after this; 0: a signal releases")
      ->check(kForSeconds);
  actuator->callback([&request, hold] { hold(kiln::HoldActuator{request.name, request.scale}); });
  CLI::App* speed = app.add_subcommand("speed", "speed scale of jogs, 0 to 1");
  speed->add_option("SCALE", request.scale)->required()->check(kiln::within(0.0, 1.0));
  speed->callback([&request] {
    request.run = [&request](Console& console) {
      return kiln::ctl::commandWithControl(console, kiln::SetSpeedScale{request.scale});
    };
  });
}

void addMacros(CLI::App& app, Request& request) {
  CLI::App* macro = app.add_subcommand("macro", "list, run or cancel macros");
  macro->require_subcommand(1);
  macro->add_subcommand("list", "what the robot has")->callback([&request] {
    request.options.role = kiln::ClientRole::Viewer;
    request.run = kiln::ctl::listMacros;
  });
  CLI::App* run = macro->add_subcommand("run", "hold a macro until it has ended (mode teleop)");
  run->add_option("NAME", request.name, "\"spray fire 1\"")->required()->check(kiln::notEmpty());
  run->add_flag("--restart", request.restart, "from its first step, even if it was interrupted");
  run->callback([&request] {
    request.run = [&request](Console& console) {
      return kiln::ctl::runMacro(console, request.name, request.restart);
    };
  });
  addSimple(*macro, request, "cancel", "end the running macro", kiln::CancelMacro{});
}

/// "there is no command 'stat'; did you mean 'state'?" where CLI11 says that one is missing.
int explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  const std::vector<std::string> unknown = app.remaining(true);
  std::vector<std::string> known;
  for (const CLI::App* command : at->get_subcommands({})) known.push_back(command->get_name());
  if (known.empty() || unknown.empty() || unknown.front().front() == '-')
    return app.exit(error) == 0 ? 0 : 2;
  const std::string near = kiln::nearestName(unknown.front(), known);
  std::fprintf(
      stderr, "kilnctl: there is no command '%s'; %s\n", unknown.front().c_str(),
      near.empty() ? "kilnctl --help lists all" : fmt::format("did you mean '{}'?", near).c_str());
  return 2;
}

std::string checkEndpoint(const std::string& endpoint) {
  const bool known = endpoint.rfind("tcp://", 0) == 0 || endpoint.rfind("ipc://", 0) == 0;
  return known ? "" : fmt::format("'{}' is no tcp://HOST:PORT or ipc:///dir/prefix", endpoint);
}

constexpr double kLongestWait_s = 3600.0;
constexpr const char* kExamples =
    "Examples:\n"
    "  kilnctl state --json\n"
    "  kilnctl mode teleop && kilnctl jog base 0.2 0 0 --seconds 2\n"
    "  kilnctl transition ArmSearch\n"
    "  kilnctl macro run \"arm park\" --take-over\n"
    "  kilnctl stop";

}  // namespace

int main(int argc, char** argv) {
  kiln::setLogLevel(4);
  Request request;
  request.options.name = defaultName();
  CLI::App app{
      "Kiln from a shell: what the station's window does, for scripts.\n"
      "Exit status: 0 done, 1 refused or failed, 2 wrong usage, 3 no link."};
  app.set_version_flag("--version", std::string("kilnctl ") + KILN_VERSION);
  app.add_option("--connect", request.options.endpoint, "tcp://127.0.0.1:PORT or ipc:///dir/prefix")
      ->envname("KILN_CONNECT")
      ->check(checkEndpoint)
      ->capture_default_str();
  app.add_option("--name", request.options.name, "operator name shown to others")
      ->capture_default_str();
  app.add_flag("--json", request.options.json, "one JSON object a line");
  app.add_flag("--take-over", request.options.take_over,
               "ask the holder for control when it is taken");
  app.add_option("--timeout", request.options.connect_s, "seconds to wait for the robot")
      ->check(kiln::within(0.1, kLongestWait_s))
      ->capture_default_str();
  app.fallthrough();  // before or behind the command
  app.footer(kExamples);
  app.require_subcommand(1);
  addViews(app, request);
  addMission(app, request);
  addPlaces(app, request);
  addLeaseAndStop(app, request);
  addHolds(app, request);
  addMacros(app, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return explain(app, error);
  }
  if (request.options.name.empty()) request.options.name = defaultName();  // others must see who
  kiln::ctl::catchSignals();
  Console console(request.options);
  const int status = request.run(console);
  if (std::fflush(stdout) == 0 || status != 0) return status;
  fmt::print(stderr, "kilnctl: what it says cannot be written: {}\n", std::strerror(errno));
  return kFailed;
}
