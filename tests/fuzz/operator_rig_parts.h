#pragma once

#include "tests/fuzz/operator_rig.h"

namespace kiln {

[[nodiscard]] const RobotGeometry& bob();

/// Carries the robot back when asked for a reset.
class OperatorRig::People final : public Arena {
 public:
  Result<void> requestReset() override {
    asked = true;
    return {};
  }
  Result<void> startClock() override { return {}; }
  bool asked = false;
};

struct OperatorRig::Parts {
  /// @param saved  where checkpoints are kept.
  Parts(const Clock& clock, Arm& arm_device, DriveBase& base_device, Pumps& pumps_device,
        Drill& drill, std::string& saved, std::function<GateSituation(Stamp)> situation);
  void tickControllers(Stamp now) {
    base.tick(now);
    arm.tick(now);
    pumps.tick(now);
  }

  StopLatch stop;
  DrillMachine machine;
  DrillMission mission;
  RobotBelief belief;
  BaseController base;
  ArmController arm;
  PumpController pumps;
  Teleop teleop;
  MacroRunner runner;
  AlarmBook alarms;
  Authority authority;
  MissionHost host;
  People people;
  MissionControl control;
};

}  // namespace kiln
