// expect: Kiln FSM: a state cannot be reached from the start state
// expect: CheckReachable<kiln::Attic, false>
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class End;
class Start : public TestState<Start, To<End>> {};
class Attic : public TestState<Attic, To<End>> {};
class End : public TestState<End, To<>, Terminal<true>> {};

using Bad = MachineOf<Context, Start, Attic, End>;
void build(const Clock& clock, Context& context) {
  Bad machine({.mission = "bad"}, clock, context);
}

}  // namespace kiln
