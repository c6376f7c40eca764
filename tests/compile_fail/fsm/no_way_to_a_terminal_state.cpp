// expect: Kiln FSM: no terminal state can be reached from a state
// expect: CheckCanEnd<kiln::Left, false>
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class Left;
class Right;
class End;
class Start : public TestState<Start, To<Left, End>> {};
class Left : public TestState<Left, To<Right>> {};
class Right : public TestState<Right, To<Left>> {};
class End : public TestState<End, To<>, Terminal<true>> {};

using Bad = MachineOf<Context, Start, Left, Right, End>;
void build(const Clock& clock, Context& context) {
  Bad machine({.mission = "bad"}, clock, context);
}

}  // namespace kiln
