#include "robot/skills/bricks/move_storage.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace kiln {

void MoveStorage::Config::visit(ConfigArchive& a) {
  a.field("tolerance_m", tolerance_m, "m", 0.0005, 0.05, "from the target: there");
  a.field("timeout_s", timeout_s, "s", 1, 120, "for the whole travel");
  a.field("max_age_s", max_age_s, "s", 0.05, 5, "of the measured state");
}

MoveStorage::MoveStorage(const Config& config, Storage& storage, std::vector<std::string> names)
    : config_(config), storage_(storage), names_(std::move(names)) {}

void MoveStorage::start(std::vector<double> targets_m, Stamp now) {
  targets_m_ = std::move(targets_m);
  began_ = now;
  status_ = {SkillPhase::Running, 0.0, "the storage travels", {}};
}

SkillStatus MoveStorage::fail(std::string code, std::string text) {
  status_ = {SkillPhase::Failed, 0.0, std::move(text), std::move(code)};
  return status_;
}

SkillStatus MoveStorage::poll(Stamp now) {
  if (status_.phase != SkillPhase::Running) return status_;
  if (auto told = storage_.write(targets_m_); !told) return fail("refused", told.error().message);
  const double waited_s = toSeconds(now - began_);
  const auto state = storage_.state();
  if (!state || toSeconds(now - state->stamp) > config_.max_age_s) {
    if (waited_s < config_.max_age_s) return status_;
    return fail("no_state", "the storage does not report");
  }
  bool there = state->compartments.size() == targets_m_.size();
  for (std::size_t i = 0; i < state->compartments.size() && i < targets_m_.size(); ++i) {
    const CompartmentState& row = state->compartments[i];
    // What it is told now it has not yet heard.
    if (row.blocked && row.target_m == targets_m_[i])
      return fail("jammed",
                  fmt::format("{} is jammed at {:.2f} m; free it", names_.at(i), row.position_m));
    there &= !row.moving && std::abs(row.position_m - targets_m_[i]) <= config_.tolerance_m;
  }
  if (there) return status_ = {SkillPhase::Done, 1.0, "the storage stands", {}};
  if (waited_s > config_.timeout_s)
    return fail("timeout",
                fmt::format("the storage did not arrive within {:.0f} s", config_.timeout_s));
  return status_;
}

}  // namespace kiln
