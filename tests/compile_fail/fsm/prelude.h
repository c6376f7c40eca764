#pragma once

#include "robot/fsm/machine_of.h"

namespace kiln {

struct Context {};

template <class Derived, class Targets, class... Options>
class TestState : public State<Context, Derived, Targets, Options...> {
 public:
  static constexpr const char* kGroup = "";
  static constexpr const char* kDoc = "";
  static constexpr const char* kConsequence = "";
  Transition execute() override { return this->stay(); }
};

}  // namespace kiln
