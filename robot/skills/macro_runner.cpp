#include "robot/skills/macro_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/core/log.h"
#include "common/core/units.h"

namespace kiln {
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
    MacroEstimate estimate;
    for (const auto& step : macro.steps) step->addTo(estimate);
    info.duration_s = estimate.duration_s;
    for (const auto& [unit, amount] : estimate.uses)
      info.uses += fmt::format("{}est. {:.1f} {}", info.uses.empty() ? "" : ", ", amount, unit);
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
  const std::optional<Pose2> work = parts_.work_pose(macro.place);
  if (!work) return fmt::format("there is no place '{}'", macro.place);
  const Pose2 base = parts_.pose();
  const double distance_m = std::hypot(base.x_m - work->x_m, base.y_m - work->y_m);
  const double turn_deg = std::abs(wrapAngle(base.yaw_rad - work->yaw_rad)) / kDeg;
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
  begin(*macro, restart);
}

void MacroRunner::begin(const Macro& macro, bool restart) {
  const bool resumes = interrupted_ && interrupted_->macro == &macro && !restart;
  const std::size_t step = resumes ? interrupted_->step : 0;
  run_ = Run{&macro, step, parts_.safety_epoch(), resumes && interrupted_->under_way};
  interrupted_.reset();
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
  MacroStep& step = *run_->macro->steps[run_->step];
  if (!std::exchange(run_->under_way, true)) {
    if (std::exchange(run_->resumes, false))
      step.resume(now);
    else
      step.start(now);
  }
  const SkillStatus status = step.poll(now);
  progress_ = status;
  if (status.phase == SkillPhase::Failed) {
    return finish(fmt::format("failed: {}: {}", step.text(), status.text), false);
  }
  if (status.phase != SkillPhase::Done) return;
  run_->under_way = false;
  if (++run_->step == run_->macro->steps.size()) finish("done", false);
}

void MacroRunner::finish(const std::string& result, bool keep_place) {
  if (!run_) return;
  if (run_->under_way) run_->macro->steps[run_->step]->abort(now_);
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
      run_->macro->steps[std::min(run_->step, run_->macro->steps.size() - 1)]->text();
  if (!progress_.text.empty()) status.step_text += ", " + progress_.text;
  status.progress = (static_cast<double>(run_->step) + progress_.progress) /
                    static_cast<double>(run_->macro->steps.size());
  return status;
}

}  // namespace kiln
