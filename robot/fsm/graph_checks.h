#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "robot/fsm/state.h"

/// What the compiler proves about a machine. Each check is a struct of its own, so that the
/// compiler's "in instantiation of ..." line names the state that is at fault.
namespace kiln::fsm_detail {

// ---- reading the options of a state ------------------------------------------------------------

struct None {};

template <template <class> class Option, class List>
struct FindOption {
  using type = None;
};
template <template <class> class Option, class T, class... Rest>
struct FindOption<Option, To<Option<T>, Rest...>> {
  using type = T;
};
template <template <class> class Option, class First, class... Rest>
struct FindOption<Option, To<First, Rest...>> : FindOption<Option, To<Rest...>> {};

template <class S>
using TimeoutTarget = typename FindOption<OnTimeout, typename S::StateOptions>::type;
template <class S>
using ResumeTarget = typename FindOption<ResumeAt, typename S::StateOptions>::type;
template <class S>
inline constexpr bool kIsSuccess = kListed<Terminal<true>, typename S::StateOptions>;
template <class S>
inline constexpr bool kIsTerminal =
    kIsSuccess<S> || kListed<Terminal<false>, typename S::StateOptions>;
template <class S>
inline constexpr bool kNeedsArguments = !std::is_default_constructible_v<S>;
template <class T>
inline constexpr bool kIsGiven = !std::is_same_v<T, None>;

// ---- the graph ---------------------------------------------------------------------------------

template <class... States>
struct Graph {
  static constexpr std::size_t kCount = sizeof...(States);
  using Reached = std::array<bool, kCount>;
  using Edges = std::array<std::array<bool, kCount>, kCount>;

  template <class S>
  static constexpr std::size_t indexOf() {
    std::size_t index = 0;
    bool found = false;
    ((found = found || std::is_same_v<S, States>, index += found ? 0 : 1), ...);
    return index;  // kCount when it is not in the machine; another check speaks up then
  }
  template <class... Targets>
  static constexpr std::array<bool, kCount> row(To<Targets...>) {
    std::array<bool, kCount> out{};
    ((indexOf<Targets>() < kCount ? void(out[indexOf<Targets>()] = true) : void()), ...);
    return out;
  }
  static constexpr Edges edges() { return Edges{row(typename States::StateTargets{})...}; }

  /// Closes `reached` along the edges, forwards or backwards.
  static constexpr Reached close(Reached reached, bool backwards) {
    const Edges e = edges();
    for (std::size_t round = 0; round < kCount; ++round)
      for (std::size_t a = 0; a < kCount; ++a)
        for (std::size_t b = 0; b < kCount; ++b)
          if (backwards ? (reached[b] && e[a][b]) : (reached[a] && e[a][b]))
            reached[backwards ? a : b] = true;
    return reached;
  }
  static constexpr Reached fromStart() {
    Reached reached{};
    reached[0] = true;
    return close(reached, false);
  }
  static constexpr Reached toTerminal() { return close(Reached{kIsTerminal<States>...}, true); }
};

// ---- checks ------------------------------------------------------------------------------------

template <class S, class Target, class All>
struct CheckListedStateIsInMachine {
  static_assert(kListed<Target, All>,
                "Kiln FSM: a state lists a target in To<...> that is not in the machine");
  static constexpr bool kOk = true;
};

template <class S, class All, class... Targets>
constexpr bool checkTargets(To<Targets...>) {
  return (CheckListedStateIsInMachine<S, Targets, All>::kOk && ... && true);
}

template <class S, bool kReachable>
struct CheckReachable {
  static_assert(kReachable, "Kiln FSM: a state cannot be reached from the start state");
  static constexpr bool kOk = true;
};

template <class S, bool kCanEnd>
struct CheckCanEnd {
  static_assert(
      kCanEnd,
      "Kiln FSM: no terminal state can be reached from a state; the mission could never end");
  static constexpr bool kOk = true;
};

template <class S, class All>
struct CheckTimeout {
  using Target = TimeoutTarget<S>;
  static constexpr bool kHasLimit = requires(const typename S::Context& context) {
    S::timeLimit(context);
  };
  static_assert(!kIsGiven<Target> || kListed<Target, typename S::StateTargets>,
                "Kiln FSM: a state's time-out target is not listed in its To<...>");
  static_assert(
      kIsGiven<Target> == kHasLimit,
      "Kiln FSM: OnTimeout<...> and `static double timeLimit(const Context&)` go together");
  static_assert(!kIsGiven<Target> || !kListed<Target, All> ||
                    std::is_default_constructible_v<Target>,
                "Kiln FSM: a time-out target must not take constructor arguments");
  static constexpr bool kOk = true;
};

template <class S, class All>
struct CheckResume {
  using Target = ResumeTarget<S>;
  static_assert(!kNeedsArguments<S> || kIsGiven<Target>,
                "Kiln FSM: a state with constructor arguments must name ResumeAt<...>, the state "
                "in which a resume starts");
  static_assert(!kIsGiven<Target> || kListed<Target, All>,
                "Kiln FSM: a state's ResumeAt<...> is not in the machine");
  static_assert(!kIsGiven<Target> || !kListed<Target, All> ||
                    std::is_default_constructible_v<Target>,
                "Kiln FSM: a state's ResumeAt<...> must not take constructor arguments itself");
  static constexpr bool kOk = true;
};

/// True, or does not compile. The first state is the start.
template <class Start, class... Rest>
constexpr bool checkGraph() {
  using All = To<Start, Rest...>;
  using G = Graph<Start, Rest...>;
  static_assert(!kNeedsArguments<Start>,
                "Kiln FSM: the start state must not take constructor arguments");
  constexpr auto kForward = G::fromStart();
  constexpr auto kBackward = G::toTerminal();
  const bool listed = checkTargets<Start, All>(typename Start::StateTargets{}) &&
                      (checkTargets<Rest, All>(typename Rest::StateTargets{}) && ... && true);
  const bool reachable =
      (CheckReachable<Rest, kForward[G::template indexOf<Rest>()]>::kOk && ... && true);
  const bool can_end =
      CheckCanEnd<Start, kBackward[0]>::kOk &&
      (CheckCanEnd<Rest, kBackward[G::template indexOf<Rest>()]>::kOk && ... && true);
  const bool timeouts =
      CheckTimeout<Start, All>::kOk && (CheckTimeout<Rest, All>::kOk && ... && true);
  const bool resumes = CheckResume<Start, All>::kOk && (CheckResume<Rest, All>::kOk && ... && true);
  return listed && reachable && can_end && timeouts && resumes;
}

}  // namespace kiln::fsm_detail
