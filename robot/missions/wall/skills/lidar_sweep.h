#pragma once

#include <deque>
#include <functional>
#include <string>

#include "common/config/config_archive.h"
#include "robot/missions/wall/skills/sweep_coverage.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/perception/cloud/scan_window.h"
#include "robot/planning/view_poses/lidar_view.h"
#include "robot/skills/motion.h"

namespace kiln {

/// What one sweep of the LiDAR brought.
struct SweepCloud {
  BrickSweep sweep;  ///< in base, which stood still
  Stamp begin, end;  ///< stamps of the first and of the last scan
  int scans = 0;
  int missing = 0;  ///< scans between them that did not come
  SweepCoverage coverage;
  Pose2 base_moved;  ///< by the wheels, from the first scan to the one farthest from it
  /// "43 scans in 4.3 s, 312000 points, tilt 4.0 to 33.1 deg, a line each 0.06 deg"
  [[nodiscard]] std::string text() const;
};

/// The sweep of the LiDAR that makes a dense cloud: the arm goes to where it begins, then turns the
/// LiDAR slowly through its tilt while the prepared scans are gathered (NimbRo UGV paper, "Rendering
/// and Sampling": the LiDAR is moved to capture a dense 3D scan). Prepared means: without the robot
/// itself, each firing where the flange was at its time. Scans of rest before and after the motion
/// do not count, nor do those that came in between two sweeps.
/// Failure codes: the arm's own (unreachable, in_collision, obstacle, contact, protective_stop,
/// tracking, stopped, timeout: it stopped on the way), base_moved (with how far), too_few_scans.
/// Confined to the mission thread.
class LidarSweep {
 public:
  struct Config {
    double scan_period_s = 0.1;
    double min_share = 0.85;    ///< of the scans that the motion has time for; fewer: failed
    double wait_s = 0.6;        ///< for the last scans, after the arm has stopped
    double max_gather_s = 5.0;  ///< from the first scan to the end of the last; later ones are left
    double max_base_m = 0.003, max_base_deg = 0.1;  ///< the base may move by no more meanwhile
    void visit(ConfigArchive& a);
  };
  using Scans = std::function<std::deque<ScanWindow::Entry>()>;
  /// @param scans  MissionParts::scans: prepared, oldest first.
  LidarSweep(const Config& config, ArmMotion& arm, Scans scans);

  /// The base rests and goes on doing so. Drops the cloud before.
  void start(const SweepMotion& motion, Stamp now);
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();
  /// @pre Done.
  [[nodiscard]] const SweepCloud& cloud() const;

 private:
  enum class Stage { Idle, Approach, Tilt, Wait, Done, Failed };
  SkillStatus fail(std::string code, std::string text);
  SkillStatus finish();
  /// Takes what has come since; false: the base has moved.
  bool gather();
  void take(const ScanWindow::Entry& entry);
  [[nodiscard]] std::string movedText() const;

  Config config_;
  ArmMotion& arm_;
  Scans scans_;
  Stage stage_ = Stage::Idle;
  SweepMotion motion_;
  Stamp tilt_began_, tilt_ended_;
  std::optional<Stamp> last_;  ///< stamp of the newest scan that was looked at
  Pose2 X_odom_first_;
  std::vector<Eigen::Isometry3d> ahead_;  ///< X_base_lidar in the middle of each scan
  SweepCloud cloud_;
  SkillStatus ended_;
};

}  // namespace kiln
