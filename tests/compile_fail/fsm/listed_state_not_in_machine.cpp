// expect: Kiln FSM: a state lists a target in To<...> that is not in the machine
// expect: CheckListedStateIsInMachine<kiln::Start, kiln::Forgotten
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class End;
class Forgotten;
class Start : public TestState<Start, To<End, Forgotten>> {};
class End : public TestState<End, To<>, Terminal<true>> {};

using Bad = MachineOf<Context, Start, End>;
void build(const Clock& clock, Context& context) {
  Bad machine({.mission = "bad"}, clock, context);
}

}  // namespace kiln
