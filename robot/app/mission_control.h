#pragma once

#include <functional>
#include <string>

#include "common/model/status.h"
#include "common/transport/log_throttle.h"
#include "robot/app/alarm_book.h"
#include "robot/app/teleop.h"
#include "robot/control/arm_controller.h"
#include "robot/hal/arena.h"
#include "robot/missions/common/mission_host.h"
#include "robot/safety/authority.h"
#include "robot/skills/macro_runner.h"

namespace kiln {

/// Executes the commands that the authority has let through, and lets what was asked for at the
/// program's start pass the same gate. Mode, STOP and mission belong to MissionHost. Confined to
/// the mission thread.
class MissionControl final : public Authority::Handler {
 public:
  struct Parts {
    MissionHost& host;
    Authority& authority;
    Teleop& teleop;
    MacroRunner& macros;
    AlarmBook& alarms;
    StopLatch& stop;
    Arm& arm;
    ArmController& arm_controller;
    Arena* arena;                 ///< nullptr: nobody can carry the robot to its start
    std::function<Pose2()> pose;  ///< newest X_map_base
    /// What the devices, checks and pictures say; the rest of the situation is added here.
    std::function<GateSituation(Stamp)> situation;
    std::function<void(const Pose2& X_map_base)> set_pose;  ///< the operator's word
    std::function<void(bool on)> set_recording;             ///< empty: this robot cannot record
  };
  explicit MissionControl(Parts parts) : parts_(std::move(parts)) {}

  [[nodiscard]] GateSituation situation(Stamp now) const override;
  [[nodiscard]] std::optional<CommandAck> execute(const Authority::Accepted& accepted,
                                                  Stamp now) override;
  void onReleased(const std::vector<HoldKind>& kinds, Stamp now) override;
  void onLeaseLost(Stamp now) override;

  /// A STOP from anywhere holds the mission and ends what is done by hand. Before anything of a
  /// tick.
  void observeStop(Stamp now);
  /// A mission does not go on from a place that nobody knows: it waits, with the reason, for an
  /// operator to resume it. @param objection  of the localisation; empty: none.
  void checkPosition(const std::string& objection, Stamp now);
  /// The world says that the robot was carried back to its start.
  void onReset(Stamp now);
  /// Steps what runs in this mode: machine or macro.
  void step(Stamp now);
  /// Mode, mission, operators and STOP; what devices and localisation know is left to others.
  [[nodiscard]] RobotStatus status(const RobotBelief& belief, std::vector<Check> checks,
                                   Stamp now) const;

 private:
  CommandAck executeDiscrete(const Command& command, Stamp now);
  void executeSetpoint(const Authority::Accepted& accepted);
  CommandAck changeState(const Command& command, const ChangeState& change, Stamp now);
  CommandAck setMode(const Command& command, Mode mode, Stamp now);
  void endHandWork(Stamp now);

  Parts parts_;
  LogThrottle stop_log_{"safety"};  ///< STOPs may come as a stream
};

}  // namespace kiln
