#include "robot/missions/common/mission_log.h"

#include <nlohmann/json.hpp>

namespace kiln {

using nlohmann::json;

void MissionLog::begin(Stamp now) {
  begun_ = now;
  states_.clear();
}

void MissionLog::observe(const FsmStatus& status) {
  for (const FsmHistoryEntry& entry : status.history) {
    if (states_.empty() || entry.step > states_.back().step) {
      states_.push_back(entry);
    } else if (entry.step == states_.back().step) {
      states_.back() = entry;  // now it may have been left
    } else if (states_.size() > 1 && entry.step == states_[states_.size() - 2].step) {
      states_[states_.size() - 2] = entry;
    }
  }
}

json MissionLog::save() const {
  json states = json::array();
  for (const FsmHistoryEntry& entry : states_)
    states.push_back({entry.step, entry.state, toNanoseconds(entry.entered),
                      toNanoseconds(entry.left), static_cast<int>(entry.cause), entry.note});
  return {{"begun_ns", toNanoseconds(begun_)}, {"states", std::move(states)}};
}

Result<void> MissionLog::restore(const json& saved, Stamp saved_at, Duration shift) {
  MissionLog out;
  try {
    out.begun_ = stampFromNanoseconds(saved.at("begun_ns").get<std::int64_t>()) + shift;
    for (const json& row : saved.at("states")) {
      const auto stamp = [&](std::size_t i) {
        return stampFromNanoseconds(row.at(i).get<std::int64_t>());
      };
      const int cause = row.at(4).get<int>();
      if (cause < 0 || cause > static_cast<int>(TransitionCause::Start))
        return makeError(ErrorCode::InvalidInput, "cause {} of a transition is unknown", cause);
      const Stamp left = stamp(3) == Stamp{} ? saved_at : stamp(3);
      out.states_.push_back({row.at(0).get<std::uint64_t>(), row.at(1).get<std::string>(),
                             stamp(2) + shift, left + shift, static_cast<TransitionCause>(cause),
                             row.at(5).get<std::string>()});
    }
  } catch (const json::exception& e) {
    return makeError(ErrorCode::InvalidInput, "the mission's log is damaged: {}", e.what());
  }
  *this = std::move(out);
  return {};
}

}  // namespace kiln
