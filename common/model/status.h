#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/model/command.h"
#include "common/model/mission.h"
#include "common/model/sensor.h"

namespace kiln {

enum class Environment : std::uint8_t { Live, Sim, Replay };
enum class StatusWord : std::uint8_t {
  NoLink,
  NotReady,
  Ready,
  Auto,
  Supervised,
  Teleop,
  Paused,
  Stopped
};
[[nodiscard]] std::string_view toString(StatusWord word);  ///< "NOT READY", ...
[[nodiscard]] std::string_view toString(Mode mode);
[[nodiscard]] std::string_view toString(ArmSafetyMode mode);

enum class AlarmLevel : std::uint8_t { Advisory, Caution, Warning };
struct Alarm {
  std::string id;  ///< stable, e.g. "arm.protective_stop"
  AlarmLevel level = AlarmLevel::Caution;
  std::string text;    ///< what and where
  std::string action;  ///< what to do
  Stamp since;
  bool active = true;
  bool acknowledged = false;
};

struct Check {  ///< preflight row
  std::string name;
  bool ok = false;
  std::string detail;    ///< what was found: "10.0 Hz", "no scan for 2.1 s"
  std::string action{};  ///< what to do when it fails or warns; empty while all is well
  bool warn = false;     ///< ok, yet look at it; a mission may start
};

struct LeaseStatus {
  std::string holder_client;  ///< empty = free
  std::string holder_name;
  std::uint64_t epoch = 0;
  double expires_in_s = 0.0;
  std::string requested_by_client;  ///< somebody asks the holder to hand over; empty = nobody
  std::string requested_by_name;
  double request_expires_in_s = 0.0;  ///< then the request is denied, unless the holder is dead
};
struct StopStatus {
  bool latched = false;
  std::string source;  ///< who or what
  Stamp since;
  /// Which STOP this is: counts every one since the daemon began, also those that found the latch
  /// set. ClearStop names it.
  std::uint64_t generation = 0;
  /// Measured at rest by data that is fresh and finite: wheels, joints, pump currents.
  bool base_at_rest = false, arm_at_rest = false, pumps_at_rest = false;
  bool standstill_proven = false;  ///< latched, and all three at rest
};
/// Where the mission is in its life (state chart: robot/missions/common/mission_host.h).
enum class MissionPhase : std::uint8_t { Idle, Waiting, Running, Held, Ended };
[[nodiscard]] std::string_view toString(MissionPhase phase);
/// Why a mission may not move; several may hold at once.
enum class HoldReason : std::uint8_t {
  OperatorPause,
  Teleop,
  Stop,
  PositionLost,
  Restored  ///< from a checkpoint, and not yet gone on
};
struct MissionHold {
  HoldReason reason = HoldReason::OperatorPause;
  std::string text;  ///< "paused by Ann"
};
struct MacroInfo {
  std::string name;  ///< "spray fire 1"
  std::string doc;
  double duration_s = 0.0;
  std::string start_condition;  ///< "start within 5 cm"
  std::string uses;             ///< what it uses up: "est. 2.1 l"; empty: nothing
};
struct MacroStatus {
  std::string running;  ///< empty = none
  int step = 0, steps = 0;
  std::string step_text;
  double progress = 0.0;    ///< 0..1
  std::string last_result;  ///< "done", "cancelled: released", "failed: ..."
};
/// What the robot's recorder does.
struct RecordingStatus {
  bool on = false;
  std::string file;  ///< name without its folder; the last one while off, empty = none yet
  double duration_s = 0.0;
  std::uint64_t bytes = 0;    ///< in the file
  std::uint64_t dropped = 0;  ///< messages that found the recorder's queue full, since start
  double disk_free_bytes = 0.0;
  std::string problem;  ///< why it ended by itself: disk nearly full; empty = none
};
struct DropCount {
  std::string topic;
  std::uint64_t dropped = 0;
};

/// Everything the top bar, cards and 3D robot need. Published at 10 Hz.
struct RobotStatus {
  Stamp stamp;
  std::uint64_t seq = 0;
  std::string robot_name = "Bob";
  std::string version;
  Environment environment = Environment::Sim;
  Mode mode = Mode::None;
  StatusWord word = StatusWord::NotReady;
  std::string reason;  ///< why NOT READY / PAUSED / STOPPED
  std::vector<Check> checks;
  LeaseStatus lease;
  StopStatus stop;
  Pose2 X_map_base;
  double pose_age_s = 0.0;
  Twist2 twist;  ///< measured, base frame
  ArmState arm;
  std::array<double, 4> wheel_steer_rad{};
  double battery_v = 0.0;
  double battery_a = 0.0;
  MacroStatus macro;
  RecordingStatus recording;
  double speed_scale = 0.35;
  double mission_elapsed_s = 0.0;
  double mission_limit_s = 900.0;
  int resets = 0;
  std::vector<Alarm> alarms;
  std::vector<DropCount> drops;
  std::vector<std::string> operators;  ///< names of connected stations
  MissionPhase phase = MissionPhase::Idle;
  std::vector<MissionHold> holds;  ///< of a mission that is Held
  std::vector<Figure> figures;     ///< of the mission, by MissionInfo::figures
};

struct LogLine {
  Stamp stamp;
  int level = 2;  ///< spdlog numbering
  std::string logger;
  std::string text;
};

/// Log lines since the last batch; published at 2 Hz.
struct LogBatch {
  std::vector<LogLine> lines;
  std::uint64_t dropped = 0;  ///< lines lost on the robot since start
};

/// First message of a robot to a station.
struct HelloReply {
  bool accepted = false;
  std::string reason;
  std::string robot_name;
  std::string version;
  std::uint32_t protocol = 0;
  std::string mission_uuid;
  Environment environment = Environment::Sim;
};
inline constexpr std::uint32_t kProtocolVersion = 3;

}  // namespace kiln
