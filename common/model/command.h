#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// What a client may do: a Viewer only looks (its STOP still counts), a Supervisor may pre-empt a
/// lease.
enum class ClientRole : std::uint8_t { Viewer, Operator, Supervisor };

enum class Mode : std::uint8_t { None, Autonomous, Supervised, Teleop, Stopped };

// --- discrete commands: acknowledged, age limit 1 s (transitions 2 s) ---------------------------

struct AcquireLease {
  bool take_over = false;
};
struct ReleaseLease {};
struct StartMission {};  ///< from READY; arms and runs
struct Pause {};
struct Resume {};
struct ChangeState {
  std::string from;
  std::uint64_t step = 0;
  std::string to;
};
struct SetMode {
  Mode mode = Mode::Autonomous;  ///< or Teleop, or Supervised where it is offered
};
/// Ends the STOP that the operator saw (StopStatus::generation); a newer one stays.
struct ClearStop {
  std::uint64_t generation = 0;
};
struct ReleaseProtectiveStop {};
struct ResetRobot {};  ///< competition reset: robot is carried back to its start
struct SetSpeedScale {
  double scale = 0.35;  ///< 0..1, teleop
};
struct CancelMacro {};
struct AcknowledgeAlarm {
  std::string id;
};
/// Moves nothing: needs no lease.
struct SetRecording {
  bool on = true;
};

/// The operator's word where the robot stands, in `map`. Refused while a mission runs unpaused and
/// while the base moves. The localisation takes it as a prior with the scatter of a start pose.
struct SetPose {
  Pose2 X_map_base;
};
/// A command that the running mission has described (MissionInfo::commands).
struct MissionCommand {
  struct Argument {
    std::string name;
    double value = 0.0;
  };
  std::string name;
  std::string target;  ///< what it is given to: "place 1"
  std::vector<Argument> arguments;
};

// --- hold-to-run setpoints: streamed at 25 Hz, never acknowledged when fine, refused at 300 ms ---

enum class JogFrame : std::uint8_t { Joint, Tool, Base };
struct JogBase {
  Twist2 twist;  ///< base frame; clamped on the robot
};
struct JogArm {
  JogFrame frame = JogFrame::Base;
  Vector6d velocity = Vector6d::Zero();  ///< rad/s, or m/s + rad/s
};
/// Runs something of the robot (MissionInfo::actuators) while held; 0 is the release.
struct HoldActuator {
  std::string name;
  double value = 0.0;
};
/// Runs while held; restart starts from the first step; an empty name is the release.
struct HoldMacro {
  std::string name;
  bool restart = false;
};
struct ReleaseAll {};  ///< explicit zero: sent three times on release

using CommandBody =
    std::variant<AcquireLease, ReleaseLease, StartMission, Pause, Resume, ChangeState, SetMode,
                 ClearStop, ReleaseProtectiveStop, ResetRobot, SetSpeedScale, CancelMacro,
                 AcknowledgeAlarm, SetRecording, SetPose, MissionCommand, JogBase, JogArm,
                 HoldActuator, HoldMacro, ReleaseAll>;

struct Command {
  std::string client_id;          ///< random per process
  std::string operator_name;      ///< shown to others
  std::uint64_t nonce = 0;        ///< unique per client, for dedup and acks
  std::uint64_t lease_epoch = 0;  ///< the lease the sender believes to hold; 0 = none
  Stamp issued;                   ///< in ROBOT time, converted by the client's clock estimate
  /// Setpoints: which press of a control holds it; grows with each press of a client. A hold
  /// belongs to one press: when it has ended, whatever the reason, the same press moves nothing any
  /// more. 0 is a release, and only a setpoint of zero may carry it.
  std::uint64_t press = 0;
  CommandBody body;
};
/// "jog_base", ...; of a MissionCommand its own name.
[[nodiscard]] std::string_view commandName(const CommandBody& body);
[[nodiscard]] bool isSetpoint(const CommandBody& body);

enum class AckOutcome : std::uint8_t { Accepted, Refused, Done, Failed, Cancelled };
struct CommandAck {
  std::string client_id;
  std::uint64_t nonce = 0;
  std::string command;
  AckOutcome outcome = AckOutcome::Accepted;
  /// Machine-readable: "no_lease", "too_old", "wrong_mode", "replayed", "moved", ...
  std::string code;
  std::string reason;  ///< one sentence: what, why, what to do
  std::string lease_holder;
  std::uint64_t lease_epoch = 0;  ///< the lease just granted (acquire_lease), else 0
};

}  // namespace kiln
