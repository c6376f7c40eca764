#pragma once

#include <functional>
#include <string>

#include "common/model/status.h"
#include "robot/app/alarm_book.h"
#include "robot/app/teleop.h"
#include "robot/control/arm_controller.h"
#include "robot/hal/arena.h"
#include "robot/missions/fire/fire_mission.h"
#include "robot/safety/authority.h"
#include "robot/skills/macro_runner.h"

namespace kiln {

/// Which mode the robot is in and how it gets from one to another: the table of architecture.md
/// section 6. Executes the commands that the authority has let through. Confined to the mission
/// thread.
class MissionControl {
 public:
  struct Parts {
    FireMission& mission;
    Teleop& teleop;
    MacroRunner& macros;
    AlarmBook& alarms;
    StopLatch& stop;
    Arm& arm;
    ArmController& arm_controller;
    Arena& arena;
    std::function<Pose2()> pose;                 ///< newest X_map_base
    std::function<std::string()> position_lost;  ///< why the robot does not know where it is; or ""
    std::function<void(const Pose2& X_map_base)> set_pose;  ///< the operator's word
    std::function<void(bool on)> set_recording;             ///< empty: this robot cannot record
  };
  explicit MissionControl(Parts parts) : parts_(parts) {}

  /// Starts the mission in autonomous mode. @pre the preflight checks hold.
  void startMission(Stamp now);
  /// After --resume: the mission was restored from its checkpoint and goes on.
  void resumeMission(Stamp now);
  /// Executes one accepted command. @return its answer; nullopt for setpoints and for a macro that
  /// answers later.
  [[nodiscard]] std::optional<CommandAck> execute(const Authority::Accepted& accepted, Stamp now);
  /// What ended since the last tick: released holds, a lost lease, a STOP that has latched.
  void onReleased(const std::vector<HoldKind>& kinds, Stamp now);
  void onLeaseLost(Stamp now);
  void watchStop(Stamp now);
  /// Autonomy may not go on: the mission waits, with the reason, for an operator to resume it.
  void holdMission(const std::string& reason, Stamp now);
  /// The world says that the robot was carried back to its start.
  void onReset(Stamp now);
  /// Steps what runs in this mode: machine or macro.
  void step(Stamp now, bool macro_held);

  [[nodiscard]] Mode mode() const { return parts_.stop.latched() ? Mode::Stopped : mode_; }
  [[nodiscard]] StatusWord word(Stamp now, bool checks_ok) const;
  [[nodiscard]] std::string reason() const;

 private:
  CommandAck executeDiscrete(const Command& command, Stamp now);
  void executeSetpoint(const Authority::Accepted& accepted);
  CommandAck changeState(const Command& command, const ChangeState& change, Stamp now);
  CommandAck setMode(const Command& command, Mode mode, Stamp now);
  void hold(Stamp now);

  Parts parts_;
  Mode mode_ = Mode::None;
  Mode before_teleop_ = Mode::None;
  std::string pause_reason_;
  bool stop_seen_ = false;
};

}  // namespace kiln
