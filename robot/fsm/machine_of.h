#pragma once

#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "robot/fsm/graph_checks.h"
#include "robot/fsm/machine_core.h"

namespace kiln {
namespace fsm_detail {

/// "AimHose" -> "Aim hose".
[[nodiscard]] inline std::string inWords(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool upper = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (upper && !out.empty()) out += ' ';
    out +=
        upper && !out.empty() ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : c;
  }
  return out;
}

template <class... Targets>
[[nodiscard]] std::vector<std::string> namesOf(To<Targets...>) {
  return {std::string(typeName<Targets>())...};
}

template <class S>
[[nodiscard]] FsmStateInfo describe([[maybe_unused]] const typename S::Context& context) {
  FsmStateInfo info;
  info.name = typeName<S>();
  if constexpr (requires { S::kLabel; })
    info.label = S::kLabel;
  else
    info.label = inWords(typeName<S>());
  info.group = S::kGroup;
  info.doc = S::kDoc;
  info.terminal = kIsTerminal<S>;
  info.success = kIsSuccess<S>;
  info.enterable = !kNeedsArguments<S>;
  if (kNeedsArguments<S>)
    info.not_enterable_reason =
        info.label + " needs data from the state before it; it cannot be entered by hand";
  if constexpr (kIsGiven<TimeoutTarget<S>>) {
    info.time_limit_s = S::timeLimit(context);
    info.timeout_target = typeName<TimeoutTarget<S>>();
  }
  return info;
}

template <class S>
[[nodiscard]] StateEntry makeEntry(typename S::Context& context) {
  StateEntry entry;
  entry.info = describe<S>(context);
  entry.targets = namesOf(typename S::StateTargets{});
  entry.consequence = S::kConsequence;
  entry.resume_state = typeName<S>();
  if constexpr (kIsGiven<ResumeTarget<S>>) entry.resume_state = typeName<ResumeTarget<S>>();
  if constexpr (!kNeedsArguments<S>)
    entry.make = [&context]() -> std::unique_ptr<AnyState> {
      auto state = std::make_unique<S>();
      state->bindContext(context);
      return state;
    };
  if constexpr (requires { S::denyEntry(context); })
    entry.deny = [&context] { return S::denyEntry(context); };
  return entry;
}

}  // namespace fsm_detail

/// A machine over the given states, which are all complete here; the first is the start state. Does
/// not compile when the graph is broken: see graph_checks.h. The context outlives the machine.
template <class Context, class StartState, class... States>
class MachineOf final : public MachineCore {
  static_assert(fsm_detail::checkGraph<StartState, States...>());

 public:
  MachineOf(Options options, const Clock& clock, Context& context)
      : MachineCore(std::move(options), clock,
                    {fsm_detail::makeEntry<StartState>(context),
                     fsm_detail::makeEntry<States>(context)...}) {}
};

}  // namespace kiln
