#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <unistd.h>

#include "common/config/command_line.h"
#include "common/core/log.h"
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
  double left = 0.0, right = 0.0, seconds = 0.0, period_s = 0.5, scale = 0.35;
  bool restart = false;
};

constexpr int kFailed = 1;
const CLI::Validator kFinite = kiln::within(-1e6, 1e6);
const CLI::Validator kForSeconds = kiln::within(0.0, 1e6);

std::string defaultName() {
  const char* user = std::getenv("USER");
  return fmt::format("kilnctl {}", user != nullptr ? user : "operator");
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
  CLI::App* transition =
      app.add_subcommand("transition", "force a transition: transition [FROM] TO");
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
  CLI::App* pose =
      app.add_subcommand("pose", "pose X Y YAW_DEG: tell the robot where it stands, in map");
  pose->add_option("POSE", request.base, "m, m, degrees")->required()->check(kFinite);
  pose->callback([&request] {
    request.run = [&request](Console& console) {
      const auto& [x, y, yaw_deg] = request.base;
      return kiln::ctl::commandWithControl(console, kiln::SetPose{{x, y, yaw_deg * M_PI / 180.0}});
    };
  });
  CLI::App* nudge = app.add_subcommand(
      "nudge", "nudge PLACE DX DY DYAW_DEG: move a configured fire place in map");
  nudge->add_option("PLACE", request.name, "\"place 1\"")->required();
  nudge->add_option("BY", request.base, "m, m, degrees")->required()->check(kFinite);
  nudge->callback([&request] {
    request.run = [&request](Console& console) {
      const auto& [dx, dy, dyaw_deg] = request.base;
      return kiln::ctl::commandWithControl(
          console, kiln::NudgePlace{request.name, {dx, dy, dyaw_deg * M_PI / 180.0}});
    };
  });
  CLI::App* go_on = app.add_subcommand("continue-despite",
                                       "go on although a check of PLACE objects; you have looked");
  go_on->add_option("PLACE", request.name, "\"place 1\"")->required();
  go_on->callback([&request] {
    request.run = [&request](Console& console) {
      return kiln::ctl::commandWithControl(console, kiln::ContinueDespite{request.name});
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
  CLI::App* jog = app.add_subcommand("jog", "move by hand while this runs (mode teleop)");
  jog->require_subcommand(1);
  CLI::App* base = jog->add_subcommand("base", "jog base VX VY WZ: m/s, m/s, rad/s in base");
  base->add_option("VELOCITY", request.base)->required()->check(kFinite);
  base->add_option("--seconds", request.seconds, "release after this; 0: a signal releases")
      ->check(kForSeconds);
  base->callback([&request, hold] {
    hold(kiln::JogBase{{request.base[0], request.base[1], request.base[2]}});
  });
  CLI::App* arm = jog->add_subcommand("arm", "jog arm V1 .. V6: rad/s per joint, or m/s and rad/s");
  arm->add_option("VELOCITY", request.arm)->required()->expected(6)->check(kFinite);
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
  CLI::App* pump =
      app.add_subcommand("pump", "pump LEFT RIGHT: duty 0 to 1 while this runs (mode teleop)");
  pump->add_option("LEFT", request.left)->required()->check(kiln::within(0.0, 1.0));
  pump->add_option("RIGHT", request.right)->required()->check(kiln::within(0.0, 1.0));
  pump->add_option("--seconds", request.seconds, "release after this; 0: a signal releases")
      ->check(kForSeconds);
  pump->callback([&request, hold] { hold(kiln::HoldPump{request.left, request.right}); });
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
      ->capture_default_str();
  app.add_option("--name", request.options.name, "operator name shown to others")
      ->capture_default_str();
  app.add_flag("--json", request.options.json, "one JSON object a line");
  app.add_flag("--take-over", request.options.take_over,
               "ask the holder for control when it is taken");
  app.add_option("--timeout", request.options.connect_s, "seconds to wait for the robot")
      ->capture_default_str()
      ->check(kiln::within(0.1, 3600.0));
  app.require_subcommand(1);
  addViews(app, request);
  addMission(app, request);
  addPlaces(app, request);
  addLeaseAndStop(app, request);
  addHolds(app, request);
  addMacros(app, request);
  if (const auto status = kiln::parseCommandLine(app, argc, argv)) return *status;
  kiln::ctl::catchSignals();
  Console console(request.options);
  const int status = request.run(console);
  if (std::fflush(stdout) == 0 || status != 0) return status;
  fmt::print(stderr, "kilnctl: what it says cannot be written: {}\n", std::strerror(errno));
  return kFailed;
}
