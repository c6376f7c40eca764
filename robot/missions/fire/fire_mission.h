#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/model/status.h"
#include "robot/fsm/machine.h"
#include "robot/missions/fire/fire_context.h"

namespace kiln {

/// The nominal belief before a mission: the arena's places, nothing known of them.
[[nodiscard]] WorldState initialWorld(const ArenaMap& arena);

/// Challenge 3 (NimbRo UGV paper, section "Challenge 3"): finds the fire and sprays it, both places
/// one after the other; or, as mission "mapping", the drive that its map is made from, with the
/// same world model, checkpoint and reset. Confined to the mission thread, except
/// machine().blocked() and machine().info().
///
/// Wiring (robot/app), each 20 ms: onDetections() for each thermal result that has arrived, then
/// tick(now). Operator commands go to machine(): start, pause, resume, changeState. In teleop and
/// after STOP pause the machine before tick(): a paused mission writes no setpoints.
class FireMission {
 public:
  struct Options {
    std::string mission_uuid{};     ///< empty: random; give one in lockstep
    std::string checkpoint_path{};  ///< empty: nothing is kept
    std::string mission = "fire";   ///< or "mapping": the mapping drive in place of the fires
  };
  FireMission(const FireDevices& devices, const FireConfig& config,
              const SprayCalibration& calibration, const Options& options);
  ~FireMission();

  [[nodiscard]] Machine& machine();
  [[nodiscard]] const Machine& machine() const;

  /// Starts mission and mission clock.
  void start(Stamp now);
  /// World model from the devices, one step of the machine, checkpoint (written by a thread of its
  /// own), snapshot.
  void tick(Stamp now);
  /// @param X_map_thermal  camera pose at the image's stamp.
  void onDetections(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal);
  /// Competition reset: the robot stands at its start again, clock and knowledge go on.
  void onReset(Stamp now);
  /// Goes on from a checkpoint file. Error: says what is wrong with it; nothing is started then.
  /// The machine stands held at its state; resume() of it goes on.
  [[nodiscard]] Result<void> resumeFrom(const std::string& path, Stamp now);
  /// Asked at each tick, kept in the checkpoint: why the mission stands still (MissionHost::holds).
  void keepHolds(std::function<std::vector<MissionHold>()> holds);
  /// What held the mission when its checkpoint was written; after resumeFrom().
  [[nodiscard]] const std::vector<MissionHold>& restoredHolds() const;

  /// Waits until the newest checkpoint is on the disk; the destructor does so too.
  void flushCheckpoint();

  /// The operator's correction of a place (NudgePlace; PlaceCheck::correction() proposes one). The
  /// mission looks at the place anew. Refused while the arm works before it.
  [[nodiscard]] Result<void> nudgePlace(const std::string& place, const Pose2& by);
  /// The operator takes the responsibility: on from "Place refused" as configured. `subject` is the
  /// place's name.
  [[nodiscard]] Result<void> continueDespite(const std::string& subject,
                                             const std::string& operator_name, Stamp now);
  /// Newest comparison of each place, as configured and nudged, with the live cloud.
  [[nodiscard]] std::vector<PlaceCheck> placeChecks() const;

  [[nodiscard]] std::vector<FirePlaceInfo> places() const;
  [[nodiscard]] std::vector<FireEstimate> fires()
      const;  ///< of each place, and the present sweep's
  [[nodiscard]] JetPreview jetPreview(Stamp now) const;
  /// Conditions of the mission that an operator must act on, e.g. a full disk; present ones only.
  [[nodiscard]] std::vector<Alarm> alarms() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
