// expect: Kiln FSM: transit<T>(args...) with arguments that T's constructor does not take
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class End;
class Start : public TestState<Start, To<End>> {
 public:
  Transition execute() override;
};
class End : public TestState<End, To<>, Terminal<true>> {};
Transition Start::execute() { return transit<End>("too much"); }

}  // namespace kiln
