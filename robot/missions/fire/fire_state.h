#pragma once

#include "robot/fsm/state.h"
#include "robot/missions/fire/fire_context.h"

namespace kiln {

class ProtectiveStop;
class TimeNearlyOver;

/// Swim lanes of the paper's flowchart, and one for what goes wrong.
inline constexpr const char* kSearchFire = "search fire";
inline constexpr const char* kExtinguish = "extinguish";
inline constexpr const char* kFaults = "faults";

/// A state of the fire mission that nothing interrupts. While paused everything rests and the pumps
/// are off; after a pause the state is entered anew, because the operator may have moved the robot.
/// Leaving stops base and arm; the pumps go on into the next spraying state and otherwise stop
/// within 200 ms.
template <class Derived, class Targets, class... Options>
class BareFireState : public State<FireContext, Derived, Targets, Options...> {
 public:
  void pause() override { this->context().haltAll(this->now()); }
  void resume() override { this->enter(); }
  void leave() override { this->context().haltMotion(); }
};

namespace fsm_detail {
template <class Targets>
struct WithInterrupts;
template <class... States>
struct WithInterrupts<To<States...>> {
  using type = To<States..., ProtectiveStop, TimeNearlyOver>;
};
}  // namespace fsm_detail

/// To ProtectiveStop when the arm has stopped itself, to TimeNearlyOver near the end of the mission
/// clock, else stay.
[[nodiscard]] Transition fireInterrupt(FireContext& context, Stamp now);

/// A working state of the fire mission: as above, and at each step first looks for a protective
/// stop and the clock.
template <class Derived, class Targets, class... Options>
class FireState : public BareFireState<Derived, typename fsm_detail::WithInterrupts<Targets>::type,
                                       Options...> {
 public:
  [[nodiscard]] Transition watch() override { return fireInterrupt(this->context(), this->now()); }
};

/// The arm's safety controller allows motion.
[[nodiscard]] bool armIsReleased(const FireContext& context);

}  // namespace kiln
