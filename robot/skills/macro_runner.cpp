#include "robot/skills/macro_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/log.h"
#include "robot/skills/macro_step.h"

namespace kiln {
namespace {
constexpr double kDeg = M_PI / 180.0;
}

void MacroRunnerConfig::visit(ConfigArchive& a) {
  a.section("aim", aim, "how the nozzle may stand before a fire place");
  a.section("pattern", pattern, "hourglass");
  a.field("flow_lpm", flow_lpm, "l/min", 0.1, 10.0, "each pump, for the list's litres");
  a.field("tank_l", tank_l, "l", 0.5, 50.0, "each tank when full");
  a.field("arm_step_s", arm_step_s, "s", 0.5, 60.0, "what the list reckons for one arm motion");
  a.field("pump_check_after_s", pump_check_after_s, "s", 0.5, 10.0,
          "a pump without current by then fails the step");
}

MacroRunner::MacroRunner(MacroRunnerConfig config, Parts parts, std::vector<Macro> macros)
    : config_(std::move(config)), parts_(std::move(parts)), macros_(std::move(macros)) {}

MacroRunner::~MacroRunner() = default;

const Macro* MacroRunner::find(const std::string& name) const {
  const auto found = std::find_if(macros_.begin(), macros_.end(),
                                  [&](const Macro& macro) { return macro.name == name; });
  return found == macros_.end() ? nullptr : &*found;
}

std::vector<MacroInfo> MacroRunner::list() const {
  std::vector<MacroInfo> infos;
  for (const Macro& macro : macros_) {
    MacroInfo info;
    info.name = macro.name;
    info.doc = macro.doc;
    double water_l = 0.0;
    for (const MacroStep& step : macro.steps) {
      const bool timed = step.action == "spray" || step.action == "wait";
      info.duration_s += timed ? step.seconds : config_.arm_step_s;
      if (step.action == "spray") {
        water_l += 2.0 * config_.flow_lpm / 60.0 * step.duty * step.seconds;
      }
    }
    if (water_l > 0.0) info.uses = fmt::format("est. {:.1f} l", water_l);
    info.start_condition =
        macro.place.empty()
            ? "anywhere"
            : fmt::format("base within {:.0f} cm and {:.0f} deg of the work pose of {}",
                          macro.start_tolerance_m * 100.0, macro.start_tolerance_deg, macro.place);
    infos.push_back(std::move(info));
  }
  return infos;
}

std::string MacroRunner::startObjection(const Macro& macro) const {
  if (macro.place.empty()) return {};
  const auto& places = parts_.arena.fire_places;
  const auto place = std::find_if(places.begin(), places.end(),
                                  [&](const auto& p) { return p.name == macro.place; });
  if (place == places.end()) return fmt::format("the arena has no fire place '{}'", macro.place);
  const Pose2 work = place->work_pose.pose();
  const Pose2 base = parts_.pose();
  const double distance_m = std::hypot(base.x_m - work.x_m, base.y_m - work.y_m);
  const double turn_deg = std::abs(wrapAngle(base.yaw_rad - work.yaw_rad)) / kDeg;
  if (distance_m <= macro.start_tolerance_m && turn_deg <= macro.start_tolerance_deg) return {};
  return fmt::format(
      "the base is {:.2f} m and {:.0f} deg off the work pose of {}; drive there first", distance_m,
      turn_deg, macro.place);
}

void MacroRunner::hold(const std::string& name, bool restart, Stamp now) {
  now_ = std::max(now_, now);
  if (run_ && run_->macro->name != name) return finish("cancelled: another macro is held", false);
  if (run_) return;
  const Macro* macro = find(name);
  const std::string objection =
      macro == nullptr ? fmt::format("there is no macro '{}'", name) : startObjection(*macro);
  if (!objection.empty()) {
    last_result_ = "failed: " + objection;
    return;
  }
  const bool go_on = interrupted_ && interrupted_->macro == macro && !restart;
  start(*macro, go_on ? interrupted_->step : 0);
}

void MacroRunner::start(const Macro& macro, std::size_t step) {
  interrupted_.reset();
  run_ = Run{&macro, step, parts_.safety_epoch(), nullptr};
  last_result_.clear();
  logger("macro")->info("{} from step {}", macro.name, step + 1);
}

void MacroRunner::poll(Stamp now, bool held) {
  now_ = now;
  if (!held) return release();
  if (!run_) return;
  if (parts_.safety_epoch() != run_->epoch) {
    return finish("cancelled: control changed or STOP", false);
  }
  const MacroStep& step = run_->macro->steps[run_->step];
  if (!run_->step_run) {
    run_->step_run = makeMacroStep(step, config_, parts_);
    run_->step_run->start(now);
  }
  const SkillStatus status = run_->step_run->poll(now);
  progress_ = status;
  if (status.phase == SkillPhase::Failed) {
    return finish(fmt::format("failed: {}: {}", stepText(step), status.text), false);
  }
  if (status.phase != SkillPhase::Done) return;
  run_->step_run.reset();
  if (++run_->step == run_->macro->steps.size()) finish("done", false);
}

void MacroRunner::finish(const std::string& result, bool keep_place) {
  if (!run_) return;
  if (run_->step_run) run_->step_run->abort(now_);
  run_->step_run.reset();
  last_result_ = result;
  logger("macro")->info("{}: {}", run_->macro->name, result);
  interrupted_.reset();
  if (keep_place) interrupted_ = std::move(run_);
  run_.reset();
}

MacroStatus MacroRunner::status() const {
  MacroStatus status;
  status.last_result = last_result_;
  if (!run_) return status;
  status.running = run_->macro->name;
  status.steps = static_cast<int>(run_->macro->steps.size());
  status.step = static_cast<int>(run_->step) + 1;
  status.step_text =
      stepText(run_->macro->steps[std::min(run_->step, run_->macro->steps.size() - 1)]);
  if (!progress_.text.empty()) status.step_text += ", " + progress_.text;
  status.progress = (static_cast<double>(run_->step) + progress_.progress) /
                    static_cast<double>(run_->macro->steps.size());
  return status;
}

}  // namespace kiln
