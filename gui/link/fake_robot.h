#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <string>
#include <vector>

#include "common/model/command.h"
#include "common/model/fsm.h"
#include "common/model/localization.h"
#include "common/model/scene.h"
#include "common/model/status.h"
#include "common/robot_model/robot_geometry.h"
#include "common/wire/fire/fire_model.h"

namespace kiln::gui {

/// A robot that acts out a seeded fire mission, for tests, screenshots and training at the desk: no
/// physics, no perception, but the same vocabulary and the same refusals as the real command gate.
/// Thread-compatible.
class FakeRobot {
 public:
  struct Ack {
    AckOutcome outcome = AckOutcome::Accepted;
    std::string code, reason;
  };
  explicit FakeRobot(std::uint64_t seed);

  /// Moves the script on to `now` (robot time, never backwards).
  void advanceTo(Stamp now);
  /// Judges and carries out one command of client `id`.
  Ack handle(const std::string& id, const std::string& name, const CommandBody& body);
  void stop(const std::string& who);
  void startMission();

  [[nodiscard]] const FsmInfo& fsmInfo() const { return info_; }
  [[nodiscard]] FsmStatus fsmStatus() const;
  [[nodiscard]] RobotStatus status() const;
  [[nodiscard]] Scene scene() const;
  [[nodiscard]] LocalizationStatus localization() const;
  [[nodiscard]] Trajectory trajectory() const;
  [[nodiscard]] std::vector<MacroInfo> macros() const;
  [[nodiscard]] MissionInfo missionInfo() const;
  [[nodiscard]] std::vector<LogLine> takeLog();
  [[nodiscard]] Stamp now() const { return now_; }
  /// Celsius at the plate as seen now; the hot spot's pixel in the thermal image is (u, v); < 0 =
  /// not in view.
  struct HotSpot {
    double u = -1, v = -1, peak_c = 22;
  };
  [[nodiscard]] HotSpot hotSpot() const;
  [[nodiscard]] bool cameraFrozen() const;
  [[nodiscard]] double missionElapsedS() const;
  [[nodiscard]] const RobotGeometry& geometry() const { return geometry_; }
  [[nodiscard]] Pose2 pose() const { return pose_; }
  /// Acts out what goes wrong: checks that fail before a start, an uncertain or lost position.
  void setChecksFail(bool fail) { checks_fail_ = fail; }
  void setHealth(LocalizationHealth health) { health_ = health; }
  [[nodiscard]] const Vector6d& joints() const { return q_; }

 private:
  struct Scripted {
    std::string state;
    double seconds;
  };
  void enter(const std::string& state, TransitionCause cause, const std::string& note);
  void moveBody(double dt_s);
  [[nodiscard]] double inStateS() const { return toSeconds(now_ - entered_) - held_s_; }
  [[nodiscard]] Ack changeState(const ChangeState& change);
  [[nodiscard]] Ack setPose(const SetPose& pose);
  [[nodiscard]] Ack nudge(const MissionCommand& nudge);
  [[nodiscard]] std::vector<Check> checks() const;
  [[nodiscard]] std::vector<FirePlaceInfo> places() const;
  [[nodiscard]] std::vector<PlaceCheck> placeChecks() const;
  void leaveTrail();
  [[nodiscard]] Ack handleWithLease(const CommandBody& body);
  [[nodiscard]] Ack handleSetpoint(const CommandBody& body);
  void say(int level, const std::string& text);
  [[nodiscard]] std::vector<GuardStatus> guards() const;
  [[nodiscard]] Pose2 goal() const;

  std::mt19937_64 random_;
  RobotGeometry geometry_;
  FsmInfo info_;
  std::vector<Scripted> script_;
  std::size_t at_ = 0;  ///< row of the script
  Stamp now_, entered_, mission_start_, mission_end_, stop_since_;
  double held_s_ = 0.0;  ///< pause inside this state
  std::uint64_t step_ = 0;
  std::string state_ = "WaitForStart";
  std::deque<FsmHistoryEntry> history_;
  bool running_ = false, paused_ = false, terminal_ = false, success_ = false;
  Mode mode_ = Mode::None;
  bool stopped_ = false;
  std::string stop_source_;
  std::string holder_, holder_name_;
  std::uint64_t epoch_ = 0;
  double speed_scale_ = 0.35;
  Pose2 pose_;
  Twist2 jog_;
  Vector6d q_;
  std::array<double, 2> duty_{}, hand_duty_{};
  std::string macro_;
  double macro_progress_ = 0.0;
  std::string macro_result_;
  std::array<double, 2> tank_{3.8, 3.9};
  double sprayed_l_ = 0.0;
  std::vector<LogLine> log_;
  bool checks_fail_ = false;
  LocalizationHealth health_ = LocalizationHealth::Good;
  std::vector<TrajectoryLeg> legs_{{}};
  std::array<Pose2, 2> nudges_{};
  bool recording_ = false;
  Stamp recording_since_;
  double recorded_s_ = 0.0;
};

/// The fire mission's graph as the station draws it.
[[nodiscard]] FsmInfo makeFakeFireGraph();
/// Nominal kitchen, for drawing.
[[nodiscard]] std::vector<SceneBox> makeFakeArena();
/// Points on its walls, as a map of two parts.
[[nodiscard]] MapLayer makeFakeMap();

}  // namespace kiln::gui
