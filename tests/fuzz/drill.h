#pragma once

#include <functional>

#include "robot/control/arm_controller.h"
#include "robot/control/base_controller.h"
#include "robot/control/pump_controller.h"
#include "robot/fsm/machine_of.h"
#include "tests/support/machine_mission.h"

namespace kiln {

/// A mission that moves base, arm and pumps at each step of its working states, and counts how
/// often it came to one.
struct Drill {
  BaseController* base = nullptr;
  ArmController* arm = nullptr;
  PumpController* pumps = nullptr;
  std::function<void()> moves;  ///< the machine writes a setpoint that moves something
  int visits = 0;               ///< its database
  bool finished = false;        ///< the world lets it end

  /// @param vx_mps  0: everything rests.
  void write(double vx_mps, Stamp now) const;
};

class DrillWork;
class DrillRest;
class DrillDone;
template <class Derived, class Targets, class... Options>
struct DrillState : State<Drill, Derived, Targets, Options...> {
  static constexpr const char* kGroup = "drill";
  static constexpr const char* kDoc = "test";
  static constexpr const char* kConsequence = "moves";
  void arrive() override { ++this->context().visits; }
  void enter() override { this->context().write(0.3, this->now()); }
  void pause() override { leave(); }
  void resume() override { this->enter(); }
  void leave() override { this->context().write(0.0, this->now()); }
};
struct DrillWork : DrillState<DrillWork, To<DrillRest, DrillDone>> {
  Transition execute() override;
};
struct DrillRest : DrillState<DrillRest, To<DrillWork>> {
  Transition execute() override;
};
struct DrillDone : DrillState<DrillDone, To<>, Terminal<true>> {
  void arrive() override {}
  void enter() override {}
  Transition execute() override { return stay(); }
};
using DrillMachine = MachineOf<Drill, DrillWork, DrillRest, DrillDone>;

class DrillMission final : public MachineMission {
 public:
  DrillMission(Machine& machine, Drill& drill) : MachineMission(machine), drill_(drill) {}
  void beginAnew(Stamp) override { drill_.visits = 0; }
  [[nodiscard]] nlohmann::json save() const override { return {{"visits", drill_.visits}}; }
  [[nodiscard]] Result<void> restore(const nlohmann::json& saved) override {
    drill_.visits = saved.at("visits");
    return {};
  }

 private:
  Drill& drill_;
};

}  // namespace kiln
