#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/stamp.h"

namespace kiln {

struct FsmStateInfo {
  std::string name;   ///< class name, unique in the machine, e.g. "AimHose"
  std::string label;  ///< "Aim hose"
  std::string group;  ///< swim lane: "search fire", "extinguish", "faults"
  std::string doc;    ///< one line
  bool terminal = false;
  bool success = false;   ///< terminal states only
  bool enterable = true;  ///< may be forced by hand
  std::string not_enterable_reason;
  double time_limit_s = 0.0;  ///< 0 = none
  std::string timeout_target;
};
struct FsmEdgeInfo {
  std::string from, to;
  bool timeout = false;
  std::string consequence;  ///< what the robot will do, for the operator
};

/// The graph; published once a mission and latched.
struct FsmInfo {
  std::string mission;  ///< "fire"
  std::string mission_uuid;
  std::string start_state;
  std::vector<FsmStateInfo> states;
  std::vector<FsmEdgeInfo> edges;
};

struct GuardStatus {
  std::string name;  ///< "Estimate within 3 cm"
  bool met = false;
  std::string detail;         ///< "2.1 cm"
  double input_age_s = -1.0;  ///< age of what it was judged from; < 0 = no input yet
};

enum class TransitionCause { Normal, Timeout, Operator, Resume, Start };
struct FsmHistoryEntry {
  std::uint64_t step = 0;
  std::string state;
  Stamp entered;
  Stamp left;  ///< == Stamp{} while current
  TransitionCause cause = TransitionCause::Normal;
  std::string note;  ///< outcome or operator name
};

struct FsmStatus {
  Stamp stamp;
  std::string mission_uuid;
  std::uint64_t step = 0;  ///< +1 at each transition: the compare-and-set key
  std::string state;
  Stamp entered;
  bool running = false;  ///< a mission has been started and has not ended
  bool paused = false;
  bool terminal = false;
  bool success = false;
  std::string display_text;
  std::vector<GuardStatus> guards;
  std::vector<FsmHistoryEntry> history;  ///< newest last, bounded
  std::string blocked;  ///< watchdog: "AimHose::execute has not returned for 1.2 s", else empty
  /// How long the machine was held since `entered`, up to `stamp`; nullopt: a robot that does not
  /// tell (recordings of before).
  std::optional<Duration> paused_in_state{};
};
/// Time in the state without the pauses, as the state's own time limit counts it.
[[nodiscard]] inline Duration timeInState(const FsmStatus& status) {
  return status.stamp - status.entered - status.paused_in_state.value_or(Duration{});
}

enum class ChangeStateOutcome { Ok, Denied, NoSuchState, NeedsArguments, Moved };
struct ChangeStateResult {
  ChangeStateOutcome outcome = ChangeStateOutcome::Ok;
  std::string reason;
};

}  // namespace kiln
