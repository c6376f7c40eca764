// expect: unused-result
#include "tests/compile_fail/fsm/prelude.h"

namespace kiln {

class End;
class Start : public TestState<Start, To<End>> {
 public:
  Transition execute() override;
};
class End : public TestState<End, To<>, Terminal<true>> {};
Transition Start::execute() {
  transit<End>();  // forgotten `return`
  return stay();
}

}  // namespace kiln
