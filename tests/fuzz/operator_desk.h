#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot/app/mission_control.h"
#include "robot/fsm/machine_of.h"
#include "tests/support/fake_devices.h"
#include "tests/support/machine_mission.h"

namespace kiln {

/// A mission that drives at each step of its working states, and counts its visits.
struct Drill {
  BaseController* base = nullptr;
  int setpoints = 0;  ///< written by the machine
  int visits = 0;
  bool finished = false;
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
  void enter() override { drive(0.3); }
  void pause() override { drive(0.0); }
  void resume() override { this->enter(); }
  void leave() override { drive(0.0); }
  void drive(double vx_mps) {
    if (vx_mps != 0.0) ++this->context().setpoints;
    BaseSetpoint setpoint;
    setpoint.stamp = this->now();
    setpoint.twist.vx_mps = vx_mps;
    this->context().base->setpoint(setpoint);
  }
};
struct DrillWork : DrillState<DrillWork, To<DrillRest, DrillDone>> {
  Transition execute() override;
};
struct DrillRest : DrillState<DrillRest, To<DrillWork>> {
  Transition execute() override;
};
struct DrillDone : DrillState<DrillDone, To<>, Terminal<true>> {
  void enter() override {}
  Transition execute() override { return stay(); }
};
using DrillMachine = MachineOf<Drill, DrillWork, DrillRest, DrillDone>;

/// What may happen to a robot.
enum class Act : std::uint8_t {
  Tick,
  LinkGap,      ///< 0.4 s without a command; the stations are still there
  LongSilence,  ///< 2.3 s without anything from the stations
  Stop,
  OtherStop,  ///< latched and acknowledged while a clear is being carried out
  MotionWatchStop,
  ClearStop,
  ClearOldStop,
  AcquireLease,
  ReleaseLease,
  TakeOver,
  JogBase,  ///< each of these four is a new press
  JogArm,
  HoldPump,
  HoldMacro,
  Again,     ///< the same control, still pressed
  OldPress,  ///< a setpoint of the press before
  Release,
  Teleop,
  Autonomous,
  Start,
  Pause,
  Resume,
  ForceWork,
  ForceDone,
  Finish,
  PositionLost,
  PositionFound,
  NotReady,
  Ready,
  ArmSilent,  ///< the device repeats its last state until DevicesBack
  BaseSilent,
  PumpsSilent,
  ProtectiveStop,
  DevicesBack,
  Reset,
  KillAndResume,
  Count
};
[[nodiscard]] const char* nameOf(Act act);

/// The robot's real authority, gate, dead-man, STOP latch, mission host and control, teleoperation,
/// macro runner and controllers, on fake devices under a manual clock, without perception and
/// sockets. Looks at the invariants after each mission tick.
class OperatorDesk final : Authority::Handler {
 public:
  explicit OperatorDesk(bool start_by_itself);
  ~OperatorDesk() override;
  /// @return the invariant that is broken, in words; empty: none.
  [[nodiscard]] std::string perform(Act act);

 private:
  struct Parts;  ///< what a kill takes with it
  class People;

  [[nodiscard]] GateSituation situation(Stamp now) const override;
  std::optional<CommandAck> execute(const Authority::Accepted& accepted, Stamp now) override;
  void onReleased(const std::vector<HoldKind>& kinds, Stamp now) override;
  void onLeaseLost(Stamp now) override;

  [[nodiscard]] GateSituation devicesAndChecks() const;
  [[nodiscard]] Stamp now() const { return clock_.now(); }
  void send(CommandBody body, std::uint64_t press = 0, const char* client = "ann");
  void press(CommandBody body);
  void stopBy(const char* who);
  void force(const char* to);
  void give(Act act);
  void killAndResume();
  void build();
  /// One mission tick and the control ticks before it.
  void tick(bool heard);
  [[nodiscard]] std::string broken();
  [[nodiscard]] std::string movesUnasked();

  ManualClock clock_{Stamp{std::chrono::seconds(100)}};
  FakeArm arm_;
  FakeBase base_;
  FakePumps pumps_;
  Drill drill_;
  std::unique_ptr<Parts> parts_;
  std::vector<ReceivedCommand> batch_;
  std::uint64_t nonce_ = 0, press_ = 0, ended_press_ = 0;
  CommandBody pressed_;  ///< the control of the newest press
  bool ready_ = true, located_ = true;
  // Of the present tick.
  int setpoints_before_ = 0;
  bool hand_moved_ = false, hand_moved_base_ = false, deliberate_ = false, acknowledged_ = false;
  std::uint64_t hand_press_ = 0;
  bool other_stop_ = false;  ///< comes while the clear is carried out
  // Over the ticks.
  bool asleep_ = false;  ///< a STOP came, and nothing deliberate since
  Stamp asleep_since_;
  Stamp base_asked_, arm_asked_, pumps_asked_;  ///< last time that somebody might move it
  bool lost_in_restart_ = false;
  int visits_expected_ = -1;
};

}  // namespace kiln
