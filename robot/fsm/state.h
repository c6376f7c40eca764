#pragma once

#include <type_traits>
#include <utility>

#include "robot/fsm/any_state.h"
#include "robot/fsm/type_name.h"

namespace kiln {

/// The states that a state may leave to; forward declarations are enough.
template <class... States>
struct To {};

/// Option: when the state's time limit is over it leaves to Target, which must be listed in To<...>
/// and take no constructor arguments. The state then has `static double timeLimit(const Context&)`,
/// seconds without pauses.
template <class Target>
struct OnTimeout {};

/// Option: after a restart of the program the mission goes on in Target instead of this state.
/// Required for a state whose constructor takes arguments.
template <class Target>
struct ResumeAt {};

/// Option: the mission ends here.
template <bool kSuccess>
struct Terminal {};

namespace fsm_detail {

template <class T, class List>
inline constexpr bool kListed = false;
template <class T, class... States>
inline constexpr bool kListed<T, To<States...>> = (std::is_same_v<T, States> || ...);

}  // namespace fsm_detail

/// Base of every state (after nimbro_fsm2's idea; NimbRo UGV paper, "High-level Control"):
///
///   class AimHose : public State<FireContext, AimHose, To<StartPump, LostTarget>,
///   OnTimeout<LostTarget>> {
///    public:
///     static constexpr const char* kGroup = "extinguish";
///     static constexpr const char* kDoc = "Brings the nozzle to its spray pose in steps of 10 cm";
///     static constexpr const char* kConsequence = "The arm moves towards the heat source";  // of
///     entering it static double timeLimit(const FireContext& context); void enter() override;
///     Transition execute() override;
///   };
///
/// Optional statics: `kLabel` (default: the class name in words) and
/// `std::string denyEntry(const Context&)`: why an operator may not enter it by hand just now,
/// empty = may.
template <class ContextT, class Derived, class Targets, class... Options>
class State : public AnyState {
 public:
  using Context = ContextT;
  using StateTargets = Targets;
  using StateOptions = To<Options...>;

  [[nodiscard]] std::string_view name() const final { return fsm_detail::typeName<Derived>(); }
  void bindContext(Context& context) { context_ = &context; }

 protected:
  [[nodiscard]] Context& context() const { return *context_; }
  [[nodiscard]] static Transition stay() { return Transition{}; }

  /// Leaves to T, constructed here from `args`. T must be complete at the call.
  template <class T, class... Args>
  [[nodiscard]] Transition transit(Args&&... args) const {
    static_assert(fsm_detail::kListed<T, Targets>,
                  "Kiln FSM: transit<T>() to a state that is not listed in this state's To<...>");
    static_assert(
        std::is_constructible_v<T, Args...>,
        "Kiln FSM: transit<T>(args...) with arguments that T's constructor does not take");
    auto next = std::make_unique<T>(std::forward<Args>(args)...);
    next->bindContext(*context_);
    return Transition{std::move(next)};
  }

 private:
  Context* context_ = nullptr;
};

}  // namespace kiln
