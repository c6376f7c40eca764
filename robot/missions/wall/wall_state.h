#pragma once

#include "robot/fsm/state.h"
#include "robot/missions/wall/wall_context.h"

namespace kiln {

class ArmStopped;
class SetBrick;
class StoreBrick;
class TakeBrick;
class WallGivenUp;

/// Swim lanes of the paper's graph of Challenge 2.
inline constexpr const char* kLocomotion = "locomotion";
inline constexpr const char* kPerception = "perception";
inline constexpr const char* kManipulation = "manipulation";
inline constexpr const char* kFallback = "fallback";

/// A state of the wall mission that nothing interrupts. While paused everything rests; after a
/// pause the state is entered anew, because the operator may have moved the robot. Leaving stops
/// base and arm.
template <class Derived, class Targets, class... Options>
class BareWallState : public State<WallContext, Derived, Targets, Options...> {
 public:
  static constexpr bool kMayHold = false;  ///< works with a brick on the gripper
  void pause() override { this->context().halt(); }
  void resume() override { this->enter(); }
  void leave() override { this->context().halt(); }
};

namespace fsm_detail {
template <class Targets>
struct WithWallInterrupts;
template <class... States>
struct WithWallInterrupts<To<States...>> {
  using type = To<States..., ArmStopped, SetBrick, StoreBrick, WallGivenUp>;
};
}  // namespace fsm_detail

/// To ArmStopped when the arm has stopped itself, to WallGivenUp at the end of the mission clock,
/// to StoreBrick or SetBrick, where it belongs, when a brick hangs on the gripper and the state does
/// not work with it: nobody stows the arm or drives with it there. Else stay.
[[nodiscard]] Transition wallInterrupt(WallContext& context, bool may_hold, Stamp now);

/// A working state of the wall mission: as above, and at each step first looks for a protective
/// stop and the clock.
template <class Derived, class Targets, class... Options>
class WallState
    : public BareWallState<Derived, typename fsm_detail::WithWallInterrupts<Targets>::type,
                           Options...> {
 public:
  [[nodiscard]] Transition watch() override {
    return wallInterrupt(this->context(), Derived::kMayHold, this->now());
  }
};

/// The arm's safety controller allows motion.
[[nodiscard]] bool armIsReleased(const WallContext& context);

}  // namespace kiln
