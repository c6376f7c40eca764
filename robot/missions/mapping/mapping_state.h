#pragma once

#include "robot/fsm/state.h"
#include "robot/missions/mapping/mapping_context.h"

namespace kiln {

inline constexpr const char* kMappingGroup = "mapping drive";

/// A state of the mapping drive. While paused everything rests; after a pause the state is entered
/// anew, because the operator may have moved the robot. Leaving stops base and arm.
template <class Derived, class Targets, class... Options>
class MappingState : public State<MappingContext, Derived, Targets, Options...> {
 public:
  static constexpr const char* kGroup = kMappingGroup;
  void pause() override { this->context().drive.cancel(); }
  void resume() override { this->enter(); }
  void leave() override { this->context().drive.cancel(); }
};

}  // namespace kiln
