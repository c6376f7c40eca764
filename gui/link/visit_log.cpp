#include "gui/link/visit_log.h"

#include <algorithm>

namespace kiln::gui {

void VisitLog::clear() {
  visits_.clear();
  first_ = 0;
}

void VisitLog::add(const FsmStatus& status) {
  if (status.mission_uuid != mission_uuid_) {
    mission_uuid_ = status.mission_uuid;
    first_ = visits_.size();
    if (first_ > 0 && visits_.back().left == Stamp{}) visits_.back().left = status.stamp;
  }
  for (const FsmHistoryEntry& entry : status.history) merge(entry);
  const bool known = visits_.size() > first_ && visits_.back().step >= status.step;
  if (status.state.empty() || known) return;
  merge({status.step, status.state, status.entered, Stamp{}, TransitionCause::Normal, {}});
}

void VisitLog::merge(const FsmHistoryEntry& entry) {
  Visit visit{entry.step,  QString::fromStdString(entry.state), entry.entered, entry.left,
              entry.cause, QString::fromStdString(entry.note)};
  const auto begin = visits_.begin() + static_cast<std::ptrdiff_t>(first_);
  const auto at =
      std::lower_bound(begin, visits_.end(), visit.step,
                       [](const Visit& v, std::uint64_t step) { return v.step < step; });
  if (at != visits_.end() && at->step == visit.step) {
    *at = std::move(visit);
    return;
  }
  // A visit that was current when we last heard of it has ended by now.
  if (at != begin && (at - 1)->left == Stamp{}) (at - 1)->left = visit.entered;
  visits_.insert(at, std::move(visit));
  if (visits_.size() <= kMaxVisits) return;
  visits_.erase(visits_.begin());
  if (first_ > 0) --first_;
}

}  // namespace kiln::gui
