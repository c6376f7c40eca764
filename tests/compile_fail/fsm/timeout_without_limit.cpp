// expect: Kiln FSM: OnTimeout<...> and `static double timeLimit(const Context&)` go together
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class End;
class Start : public TestState<Start, To<End>, OnTimeout<End>> {};
class End : public TestState<End, To<>, Terminal<true>> {};

using Bad = MachineOf<Context, Start, End>;
void build(const Clock& clock, Context& context) {
  Bad machine({.mission = "bad"}, clock, context);
}

}  // namespace kiln
