#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/ctl/commands.h"
#include "gui/ctl/json_view.h"
#include "gui/ctl/signals.h"

namespace kiln::ctl {
namespace {

constexpr double kRefresh_s = 0.04;  // the session streams at 25 Hz by itself; this keeps it alive
constexpr double kZeros_s = 0.2;     // three zeros at 25 Hz, and a little
constexpr double kMacroStart_s = 1.5;  // by then a status must have shown it

constexpr double kTeleopSpeed_mps = 1.0, kTeleopYawRate_radps = 0.6;  // robot/app Teleop::Config
constexpr double kToolSpeed_mps = 0.25, kTurnRate_radps = 0.6;

/// What asks the robot for this very speed: it takes a jog as a share of the speed scale.
/// @return  Error{Refused} for one that the scale does not allow.
Result<CommandBody> unscaled(const CommandBody& setpoint, double scale) {
  if (std::holds_alternative<HoldActuator>(setpoint)) return setpoint;
  if (scale <= 0.0)
    return makeError(ErrorCode::Refused, "the speed scale is 0: kilnctl speed 0.35");
  double most = 0.0;  // share of the full speed
  CommandBody out = setpoint;
  if (auto* jog = std::get_if<JogBase>(&out)) {
    Twist2& v = jog->twist;
    most = std::max({std::abs(v.vx_mps) / kTeleopSpeed_mps, std::abs(v.vy_mps) / kTeleopSpeed_mps,
                     std::abs(v.wz_radps) / kTeleopYawRate_radps});
    v = {v.vx_mps / scale, v.vy_mps / scale, v.wz_radps / scale};
  } else if (auto* arm = std::get_if<JogArm>(&out)) {
    const bool joints = arm->frame == JogFrame::Joint;
    most = std::max(
        arm->velocity.head<3>().cwiseAbs().maxCoeff() / (joints ? kTurnRate_radps : kToolSpeed_mps),
        arm->velocity.tail<3>().cwiseAbs().maxCoeff() / kTurnRate_radps);
    arm->velocity /= scale;
  }
  if (most <= scale + 1e-6) return out;
  if (most > 1.0) return makeError(ErrorCode::Refused, "faster than the robot moves by hand");
  return makeError(ErrorCode::Refused,
                   "needs a speed scale of {:.2f}, it is {:.2f}: kilnctl speed {:.2f}", most, scale,
                   std::ceil(most * 100) / 100);
}

int refused(Console& console, const CommandUpdate& update) {
  console.printRefusal(toJson(update),
                       fmt::format("{}: refused: {}", update.command, update.reason));
  return kRefused;
}

/// Streams until `over` says so. Every way out is a release.
int stream(Console& console, CommandBody setpoint,
           const std::function<std::optional<int>()>& over) {
  std::optional<int> code;
  const std::uint64_t press = console.session().press();
  while (!code) {
    console.session().hold(setpoint, press);
    if (auto* macro = std::get_if<HoldMacro>(&setpoint)) macro->restart = false;
    console.pauseFor(kRefresh_s);
    if (const auto refusal = console.takeRefusal()) {
      code = refused(console, *refusal);
    } else if (console.lost()) {
      code = console.fail(kNoLink, fmt::format("released: {}", console.session().link().reason));
    } else if (!console.session().lease().mine) {
      code = console.fail(kRefused, "released: control was lost (STOP or take-over)", "lease_lost");
    } else {
      code = over();
    }
  }
  console.session().releaseAll();
  const Stamp start = console.clock().now();
  while (toSeconds(console.clock().now() - start) < kZeros_s && !console.lost())
    console.sleepThroughSignals(kRefresh_s);
  return *code;
}

}  // namespace

int holdSetpoint(Console& console, const CommandBody& setpoint, double seconds) {
  if (!console.connect()) return kNoLink;
  const std::string name(commandName(setpoint));
  const auto asked = unscaled(setpoint, console.status().speed_scale);
  if (!asked) return console.fail(kRefused, fmt::format("{}: {}", name, asked.error().message));
  if (!console.takeControl()) return kRefused;
  const Stamp start = console.clock().now();
  const int code = stream(console, *asked, [&]() -> std::optional<int> {
    const double held_s = toSeconds(console.clock().now() - start);
    if (!signalled() && (seconds <= 0.0 || held_s < seconds)) return std::nullopt;
    console.print({{"outcome", "done"}, {"command", name}, {"held_s", held_s}},
                  fmt::format("{}: released after {:.2f} s", name, held_s));
    return kDone;
  });
  console.giveControlBack();
  return code;
}

int runMacro(Console& console, const std::string& name, bool restart) {
  if (!console.connect()) return kNoLink;
  if (!console.takeControl()) return kRefused;
  const Stamp start = console.clock().now();
  bool seen = false;
  std::string shown;
  const int code = stream(console, HoldMacro{name, restart}, [&]() -> std::optional<int> {
    const MacroStatus macro = console.status().macro;
    seen = seen || macro.running == name;
    if (signalled()) return console.fail(kRefused, "released: the macro is cancelled", "released");
    if (macro.running == name) {
      const std::string line =
          fmt::format("{} {}/{} {}", name, macro.step, macro.steps, macro.step_text);
      if (line != std::exchange(shown, line)) {
        console.print({{"macro", name},
                       {"step", macro.step},
                       {"steps", macro.steps},
                       {"text", macro.step_text},
                       {"progress", macro.progress}},
                      line);
      }
      return std::nullopt;
    }
    if (!seen && toSeconds(console.clock().now() - start) < kMacroStart_s) return std::nullopt;
    if (macro.last_result == "done") {
      console.print({{"outcome", "done"}, {"macro", name}}, fmt::format("{}: done", name));
      return kDone;
    }
    return console.fail(kRefused,
                        macro.last_result.empty() ? "the macro did not start" : macro.last_result,
                        "macro");
  });
  console.giveControlBack();
  return code;
}

}  // namespace kiln::ctl
