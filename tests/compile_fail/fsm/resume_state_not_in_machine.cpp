// expect: Kiln FSM: a state's ResumeAt<...> is not in the machine
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class End;
class Elsewhere;
class Start : public TestState<Start, To<End>, ResumeAt<Elsewhere>> {};
class End : public TestState<End, To<>, Terminal<true>> {};

using Bad = MachineOf<Context, Start, End>;
void build(const Clock& clock, Context& context) {
  Bad machine({.mission = "bad"}, clock, context);
}

}  // namespace kiln
