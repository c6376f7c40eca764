// expect: Kiln FSM: a state with constructor arguments must name ResumeAt<...>
// expect: CheckResume<kiln::Middle
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class Middle;
class End;
class Start : public TestState<Start, To<Middle>> {};
class Middle : public TestState<Middle, To<End>> {
 public:
  explicit Middle(int) {}
};
class End : public TestState<End, To<>, Terminal<true>> {};

using Bad = MachineOf<Context, Start, Middle, End>;
void build(const Clock& clock, Context& context) {
  Bad machine({.mission = "bad"}, clock, context);
}

}  // namespace kiln
