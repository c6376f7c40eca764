#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "common/core/clock.h"
#include "robot/control/arm_controller.h"
#include "robot/control/pump_controller.h"
#include "robot/hal/lidar.h"
#include "robot/hal/rgb_camera.h"
#include "robot/hal/thermal_camera.h"
#include "robot/scene/fire_site_map.h"
#include "robot/skills/move_arm.h"

namespace kiln {

/// What the calibration works with: the robot's devices, whoever stands behind them; nullptr: this
/// robot has none.
struct CalibrationDevices {
  Arm& arm;
  Lidar& lidar;
  const Clock& clock;
  /// Lets one control period pass: writes what was commanded, delivers what was measured.
  std::function<Result<void>()> step;
  Pumps* pumps = nullptr;
  ThermalCamera* thermal = nullptr;
  RgbCamera* operator_camera = nullptr;
};

/// Where it stands, as configured.
struct CalibrationYard {
  ArenaMap arena;
  FireSiteMap site;  ///< the first place is the hot plate
};

/// The robot at rest in the yard, as the parts of the calibration use it: time passes, the arm goes
/// from posture to posture, the newest frame of a sensor is awaited, the pumps run and stop. The
/// pump board gets its heartbeat, zeros, whenever nothing is sprayed; when the rig ends the pumps
/// are switched off. Confined to one thread.
class CalibrationRig {
 public:
  struct Config {
    double speed_scale = 0.5;  ///< of the joint limits; the base stands, nobody is near
    double settle_s = 0.3;     ///< after a motion, before anything is measured
  };
  CalibrationRig(const Config& config, const RobotGeometry& nominal, const CalibrationYard& yard,
                 CalibrationDevices devices);
  ~CalibrationRig();
  CalibrationRig(const CalibrationRig&) = delete;
  CalibrationRig& operator=(const CalibrationRig&) = delete;

  [[nodiscard]] Result<void> startSensors();
  /// No more scans.
  void restLidar() { devices_.lidar.stop(); }
  [[nodiscard]] Result<void> pass(double seconds);
  /// First frame that begins now or later. Errors: Timeout, saying which cable to look at;
  /// Unavailable: the robot has no such sensor.
  [[nodiscard]] Result<PointCloudPtr> nextScan();
  [[nodiscard]] Result<ThermalImagePtr> nextImage();
  /// Runs the operator camera for one picture.
  [[nodiscard]] Result<RgbImagePtr> takePicture();

  /// Moves there and comes to rest. Error: Refused when the arm cannot get there.
  [[nodiscard]] Result<void> moveTo(const Vector6d& q);
  [[nodiscard]] Result<Vector6d> joints() const;
  [[nodiscard]] Result<Eigen::Isometry3d> flange() const;  ///< X_base_flange by the joints
  /// The first `count` of the postures `first`, `first` + 1, ... that the arm can take, in an order
  /// that makes a short way.
  [[nodiscard]] std::vector<Vector6d> reachable(
      int first, int count, const std::function<Eigen::Isometry3d(int)>& posture) const;
  /// Goes to each and measures; a posture the arm cannot reach on its way is left out.
  /// @return how many were visited.
  [[nodiscard]] Result<int> visit(const std::vector<Vector6d>& postures,
                                  const std::function<Result<void>()>& measure);

  [[nodiscard]] bool hasThermal() const { return devices_.thermal != nullptr; }
  [[nodiscard]] bool hasPumps() const { return pumps_.has_value(); }
  /// Both pumps at full duty from now on, kept alive by pass(); false: off.
  void spray(bool on);
  /// What the pumps' model believes. Error: Unavailable when a pump draws no current or is blocked.
  [[nodiscard]] Result<PumpTracking> pumps() const;

  [[nodiscard]] const RobotGeometry& nominal() const { return nominal_; }
  /// The yard as its map says, and from where the robot was thought to start.
  [[nodiscard]] const ArenaMap& yard() const { return yard_.arena; }
  [[nodiscard]] const FirePlaceConfig& plate() const { return yard_.site.places.front(); }
  [[nodiscard]] Eigen::Isometry3d X_base_map() const;
  [[nodiscard]] const Clock& clock() const { return devices_.clock; }
  /// The arm plans with this box where it was found, in base, instead of keeping clear of all
  /// places where it may be.
  void placeWall(const std::string& name, const Eigen::Isometry3d& X_base_box);

 private:
  const Config config_;
  const RobotGeometry nominal_;
  const CalibrationYard yard_;
  CalibrationDevices devices_;
  ArenaMap planned_yard_;
  StopLatch stop_;
  ArmController arm_;
  std::optional<PumpController> pumps_;
  MoveArm mover_;
  SkillStatus motion_;
  PointCloudPtr scan_;
  ThermalImagePtr image_;
  RgbImagePtr picture_;
  bool spraying_ = false;
  int steps_ = 0;
};

/// The n-th of numbers that fill (-limit, limit) evenly, however many are taken (van der Corput);
/// different primes for different coordinates.
[[nodiscard]] double spread(int n, int prime, double limit);

}  // namespace kiln
