#pragma once

#include <QString>
#include <string>
#include <vector>

#include "common/model/fsm.h"

namespace kiln::gui {

/// One stay in a state.
struct Visit {
  std::uint64_t step = 0;
  QString state;
  Stamp entered;
  Stamp left;  ///< == Stamp{} while current
  TransitionCause cause = TransitionCause::Normal;
  QString note;
};

/// The states that a machine has been in, from its statuses and the histories in them. Missions
/// follow each other: a new one counts its steps anew.
class VisitLog {
 public:
  static constexpr std::size_t kMaxVisits = 1000;
  void add(const FsmStatus& status);
  void clear();
  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }  ///< oldest first

 private:
  void merge(const FsmHistoryEntry& entry);
  std::vector<Visit> visits_;
  std::size_t first_ = 0;  ///< index of the present mission's first one
  std::string mission_uuid_;
};

}  // namespace kiln::gui
