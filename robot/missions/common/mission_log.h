#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/core/error.h"
#include "common/model/fsm.h"

namespace kiln {

/// When the present mission began and every state that it was in since, over restarts of the
/// program too. Confined to the mission thread.
class MissionLog {
 public:
  void begin(Stamp now);
  /// Once a tick: picks up every transition from the bounded history of the status.
  void observe(const FsmStatus& status);

  [[nodiscard]] Stamp begun() const { return begun_; }
  /// In order; the last one is the current state (left == Stamp{}).
  [[nodiscard]] const std::vector<FsmHistoryEntry>& states() const { return states_; }

  [[nodiscard]] nlohmann::json save() const;
  /// The state that stood when the program ended counts as left at `saved_at`.
  /// @param shift  added to each stamp: robot time began anew.
  /// Error: InvalidInput.
  [[nodiscard]] Result<void> restore(const nlohmann::json& saved, Stamp saved_at, Duration shift);

 private:
  Stamp begun_;
  std::vector<FsmHistoryEntry> states_;
};

}  // namespace kiln
