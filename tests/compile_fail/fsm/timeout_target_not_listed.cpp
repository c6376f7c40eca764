// expect: Kiln FSM: a state's time-out target is not listed in its To<...>
// expect: CheckTimeout<kiln::Start
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class Middle;
class End;
class Start : public TestState<Start, To<Middle>, OnTimeout<End>> {
 public:
  static double timeLimit(const Context&) { return 1.0; }
};
class Middle : public TestState<Middle, To<End>> {};
class End : public TestState<End, To<>, Terminal<true>> {};

using Bad = MachineOf<Context, Start, Middle, End>;
void build(const Clock& clock, Context& context) {
  Bad machine({.mission = "bad"}, clock, context);
}

}  // namespace kiln
