#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "common/transport/log_throttle.h"
#include "robot/app/alarm_book.h"
#include "robot/app/mission_control.h"
#include "robot/app/robot_mission.h"
#include "robot/app/teleop.h"
#include "robot/safety/authority.h"
#include "robot/skills/macro_runner.h"

namespace kiln {

/// Where operators are listened to: authority, teleoperation, macros, and what executes their
/// commands. Confined to the mission thread.
class OperatorDesk {
 public:
  /// @param link  nullptr: there are no operators.
  OperatorDesk(RobotBody& body, RobotMission& mission, OperatorLink* link)
      : body_(body),
        mission_(mission),
        link_(link),
        authority_(body.settings.authority),
        teleop_(body.settings.teleop, body.robot, body.arena, body.base, body.arm, body.pumps) {}

  struct Hooks {
    /// What devices, checks and pictures say.
    std::function<GateSituation(Stamp)> situation;
    std::function<void(const Pose2& X_map_base)> set_pose;  ///< the operator's word
  };
  /// After the mission was made. Error: a macro file that is wrong.
  [[nodiscard]] Result<void> open(Hooks hooks);
  /// STOPs and commands since the last tick.
  void handleCommands(Stamp now);

  [[nodiscard]] MissionControl& control() { return *control_; }
  [[nodiscard]] const MissionControl& control() const { return *control_; }
  [[nodiscard]] const Authority& authority() const { return authority_; }
  [[nodiscard]] const Teleop& teleop() const { return teleop_; }
  [[nodiscard]] const MacroRunner& macros() const { return *macros_; }
  [[nodiscard]] AlarmBook& alarms() { return alarms_; }
  [[nodiscard]] const AlarmBook& alarms() const { return alarms_; }

 private:
  RobotBody& body_;
  RobotMission& mission_;
  OperatorLink* link_;
  Authority authority_;
  Teleop teleop_;
  AlarmBook alarms_;
  std::optional<MacroRunner> macros_;
  std::optional<MissionControl> control_;
  LogThrottle log_{"operators", 8.0};  ///< anybody may take and give back all day
};

}  // namespace kiln
