// The control: everything that the other cases break, done right.
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class Middle;
class End;
class Start : public TestState<Start, To<Middle, End>, OnTimeout<End>> {
 public:
  static double timeLimit(const Context&) { return 1.0; }
  Transition execute() override;
};
class Middle : public TestState<Middle, To<End>, ResumeAt<Start>> {
 public:
  explicit Middle(int) {}
};
class End : public TestState<End, To<>, Terminal<true>> {};
Transition Start::execute() { return transit<Middle>(3).because("it may"); }

using Good = MachineOf<Context, Start, Middle, End>;
void build(const Clock& clock, Context& context) {
  Good machine({.mission = "good"}, clock, context);
}

}  // namespace kiln
