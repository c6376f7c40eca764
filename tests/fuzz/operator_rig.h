#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "robot/app/mission_control.h"
#include "tests/fuzz/drill.h"
#include "tests/support/fake_devices.h"

namespace kiln {

/// What may happen to a robot.
enum class Act : std::uint8_t {
  Tick,
  And,          ///< what follows comes in the tick of what is before
  LinkGap,      ///< 0.4 s without a command; the stations are still there
  LongSilence,  ///< 2.3 s without anything from the stations
  Stop,
  LateStop,   ///< latched and acknowledged after the commands of the tick
  OtherStop,  ///< ... while a clear is being carried out
  MotionWatchStop,
  ClearStop,
  ClearOldStop,
  AcquireLease,
  ReleaseLease,
  TakeOver,  ///< by the other operator
  JogBase,   ///< each of these six is a new press
  JogArm,
  HoldPumps,
  HoldMacro,
  RestartMacro,
  HoldNoMacro,  ///< one that there is not: its start is refused
  Again,        ///< the newest press goes on
  OldPress,     ///< the press before it goes on
  OldLeaseJog,
  OtherJogs,  ///< the other operator, always the same press
  LateJog,    ///< 0.5 s on its way
  Replay,     ///< the newest command once more
  Release,
  CancelMacro,
  Teleop,
  Autonomous,
  Start,
  Pause,
  Resume,
  ForceWork,
  ForceDone,
  ForceOldStep,
  Finish,
  PositionLost,
  PositionFound,
  NotReady,
  Ready,
  Blind,  ///< no picture reaches the operator
  Sees,
  SlowLink,
  FastLink,
  ArmSilent,  ///< the device repeats its last state until DevicesBack
  BaseSilent,
  PumpsSilent,
  ProtectiveStop,
  DevicesBack,
  Reset,
  KillAndResume,
  Count
};
[[nodiscard]] std::string_view nameOf(Act act);
/// @pre the name of an act.
[[nodiscard]] Act actOf(std::string_view name);

/// The robot's real authority, gate, dead-man, STOP latch, mission host and control, teleoperation,
/// macro runner, checkpoints and controllers, on fake devices under a manual clock, without
/// perception and sockets. Judges the invariants of decision 0016 from what went in and what came
/// out.
class OperatorRig final : Authority::Handler {
 public:
  explicit OperatorRig(bool start_by_itself);
  ~OperatorRig() override;
  /// To be followed by tick(), or by another act of the same tick.
  void give(Act act);
  /// One mission tick and the control ticks before it.
  void tick() { tick(true); }
  /// The invariant that was broken first, in words; empty: none.
  [[nodiscard]] const std::string& broken() const { return broken_; }

 private:
  struct Parts;  ///< what a kill takes with it
  class People;
  struct Sent {
    Command command;
    Duration age{};  ///< when the robot gets it
  };
  /// One press of a control.
  struct Press {
    CommandBody body;
    bool over = false;    ///< may move nothing any more
    bool sent = false;    ///< in this tick, in good time and by who holds the lease
    bool obeyed = false;  ///< in this tick
    std::uint64_t released = ~std::uint64_t{0};  ///< number of the command
    std::optional<Stamp> last{};                 ///< obeyed
    std::uint64_t lease = 0, epoch = 0;
  };

  [[nodiscard]] GateSituation situation(Stamp now) const override;
  std::optional<CommandAck> execute(const Authority::Accepted& accepted, Stamp now) override;
  void onReleased(const std::vector<HoldKind>& kinds, Stamp now) override;
  void onLeaseLost(Stamp now) override;

  [[nodiscard]] GateSituation devicesAndChecks() const;
  [[nodiscard]] Stamp now() const { return clock_.now(); }
  void build();
  void tick(bool heard);
  void handleCommands(bool heard);

  // Acts (operator_rig_acts.cpp).
  Sent& send(CommandBody body, std::uint64_t press = 0, const char* client = "ann");
  void press(CommandBody body);
  void goOn(std::size_t presses_back);
  void release();
  void stopBy(const char* who);
  void force(const char* to, std::uint64_t steps_back);
  void quiet(int ticks, bool heard);
  void giveCommand(Act act);
  void giveEvent(Act act);
  void killAndResume();

  // Invariants.
  void breaks(const char* what);
  void judgeCommand(const Command& command);
  void judgeSetpoint(const Command& command);
  void noteDone(const Command& command, Mode mode_before);
  [[nodiscard]] bool letsGo(const CommandBody& body) const;
  void judgeMachineWrite();
  void judgeTick();
  void judgeWriters();
  void judgePresses();
  void judgeMotion();
  void judgeCounters();

  ManualClock clock_{Stamp{std::chrono::seconds(100)}};
  FakeArm arm_;
  FakeBase base_;
  FakePumps pumps_;
  MissionInfo info_;
  Drill drill_;
  std::string saved_;  ///< newest checkpoint, as on disk
  std::unique_ptr<Parts> parts_;
  std::vector<Sent> batch_;
  std::optional<Sent> newest_;
  std::uint64_t nonce_ = 0;
  std::vector<Press> presses_;                    ///< press number - 1
  bool other_sent_ = false, other_over_ = false;  ///< the one press of the other operator
  bool ready_ = true, located_ = true, sees_ = true, slow_ = false;
  bool other_stop_ = false;  ///< comes while a clear is carried out
  bool late_stop_ = false;   ///< comes after the commands of this tick

  std::string broken_;
  std::set<std::uint64_t> done_;    ///< nonces
  std::set<std::uint64_t> worked_;  ///< steps in which the machine has moved
  // Of the present tick.
  bool stop_unseen_ = false;  ///< it came after the tick had looked
  bool acknowledged_ = false;
  // Over the ticks.
  bool asleep_ = false;          ///< a STOP came, and nothing deliberate since
  bool machine_asleep_ = false;  ///< held, and neither started nor resumed since
  Stamp asleep_since_;
  Stamp base_asked_, arm_asked_, pumps_asked_;  ///< last time that somebody might move it
  Writer base_writer_ = Writer::Program, arm_writer_ = Writer::Program,
         pumps_writer_ = Writer::Program;
  Vector6d q_;        ///< measured
  Pose2 X_map_base_;  ///< true
};

}  // namespace kiln
