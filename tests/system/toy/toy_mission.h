#pragma once

#include "robot/fsm/state.h"
#include "robot/missions/common/mission_kind.h"
#include "robot/missions/common/stowed_drive.h"

namespace kiln {

/// The smallest mission that does something: waits, drives ahead, is done. Everything that a
/// mission must bring stands in this folder; resources/docs/extending.md tells it step by step.
struct ToyConfig {
  double wait_s = 0.5;
  double distance_m = 1.0;  ///< straight ahead of the start
  void visit(ConfigArchive& a);
};

struct ToyContext {
  ToyConfig config;
  StowedDrive drive;
  std::function<Pose2()> pose;  ///< newest X_map_base
  int drives = 0;
  double pushed_m = 0.0;  ///< by operators
  [[nodiscard]] Pose2 goal() const { return {config.distance_m + pushed_m, 0.0, 0.0}; }
};

class ToyDrive;
class ToyDone;
class ToyStuck;

template <class Derived, class Targets, class... Options>
struct ToyState : State<ToyContext, Derived, Targets, Options...> {
  static constexpr const char* kGroup = "toy";
  void pause() override { this->context().drive.cancel(); }
  void resume() override { this->enter(); }
  void leave() override { this->context().drive.cancel(); }
};

struct ToyWait : ToyState<ToyWait, To<ToyDrive>> {
  static constexpr const char* kDoc = "Waits a moment";
  static constexpr const char* kConsequence = "The robot stands still";
  Transition execute() override;
};

struct ToyDrive : ToyState<ToyDrive, To<ToyDone, ToyStuck>> {
  static constexpr const char* kDoc = "Drives ahead";
  static constexpr const char* kConsequence = "The base drives";
  void arrive() override { ++context().drives; }
  void enter() override;
  Transition execute() override;
};

struct ToyDone : ToyState<ToyDone, To<>, Terminal<true>> {
  static constexpr const char* kDoc = "Has arrived";
  static constexpr const char* kConsequence = "The mission ends as a success";
  Transition execute() override { return stay(); }
};

struct ToyStuck : ToyState<ToyStuck, To<>, Terminal<false>> {
  static constexpr const char* kDoc = "Could not drive";
  static constexpr const char* kConsequence = "The mission ends as a failure";
  Transition execute() override { return stay(); }
};

[[nodiscard]] MissionKind toyMissionKind();

}  // namespace kiln
