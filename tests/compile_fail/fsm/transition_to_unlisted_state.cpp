// expect: Kiln FSM: transit<T>() to a state that is not listed in this state's To<...>
// expect: transit
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class End;
class Elsewhere;
class Start : public TestState<Start, To<End>> {
 public:
  Transition execute() override;
};
class End : public TestState<End, To<>, Terminal<true>> {};
class Elsewhere : public TestState<Elsewhere, To<End>> {};
Transition Start::execute() { return transit<Elsewhere>(); }

}  // namespace kiln
