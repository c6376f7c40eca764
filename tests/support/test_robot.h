#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/core/clock.h"
#include "common/model/command.h"
#include "common/model/fsm.h"
#include "common/model/localization.h"
#include "common/model/scene.h"
#include "common/model/status.h"
#include "common/robot_model/robot_geometry.h"

namespace kiln {

enum class HoldKind : std::uint8_t;
class FakeArm;
class FakePumps;
class AlarmBook;

/// The robot's own authority, gate, mission host, fire mission, skills and controllers on fake
/// devices under a manual clock, without sockets: what a station is tested against. It knows where
/// it is without looking (`health` says how well), sees nothing around but boxes that stand where
/// they are configured (`misplaced`), and a plate that warms up in the second place.
class TestRobot {
 public:
  TestRobot();  ///< loads the shipped configuration
  ~TestRobot();

  /// Control at 125 Hz, mission at 50 Hz.
  void advance(double seconds);
  /// Arrives with the next mission tick. @return its nonce.
  std::uint64_t send(const std::string& client, const std::string& name, CommandBody body,
                     std::uint64_t press = 0);
  /// send() and the tick that answers it.
  CommandAck ask(const std::string& client, const std::string& name, CommandBody body);
  /// Is heard of, or not any more: then its lease ends.
  void setHeard(const std::string& client, bool heard);
  void stop(const std::string& who);
  /// As `--start` does.
  void startMission();

  [[nodiscard]] std::vector<CommandAck> takeAcks();
  [[nodiscard]] std::vector<LogLine> takeLog();
  [[nodiscard]] FsmInfo fsmInfo() const;
  [[nodiscard]] FsmStatus fsmStatus() const;
  [[nodiscard]] RobotStatus status() const;
  [[nodiscard]] Scene scene() const;
  [[nodiscard]] LocalizationStatus localization() const;
  [[nodiscard]] const Trajectory& trajectory() const;
  [[nodiscard]] std::vector<MacroInfo> macros() const;
  /// Newest picture and what the mission made of one; nullptr: none yet.
  [[nodiscard]] const ThermalImagePtr& thermal() const;
  [[nodiscard]] const std::shared_ptr<const MissionDetail>& stream() const;
  [[nodiscard]] const MissionInfo& missionInfo() const;

  [[nodiscard]] Stamp now() const { return clock().now(); }
  [[nodiscard]] const Clock& clock() const;
  [[nodiscard]] Pose2 pose() const;  ///< X_map_base
  /// A hold of this kind is alive.
  [[nodiscard]] bool held(HoldKind kind) const;
  [[nodiscard]] AlarmBook& alarms();
  [[nodiscard]] FakeArm& arm();
  [[nodiscard]] FakePumps& pumps();

  std::vector<Check> checks;  ///< of the preflight, before those of the mission
  LocalizationHealth health = LocalizationHealth::Good;
  double view_age_s = 0.1;  ///< of the newest picture that left for the operator
  double rtt_s = 0.02;
  Pose2 misplaced;  ///< of the second place, from where it is configured

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
