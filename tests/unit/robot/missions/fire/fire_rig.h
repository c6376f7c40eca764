#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/core/manual_executor.h"
#include "robot/missions/common/mission_host.h"
#include "robot/missions/fire/fire_mission.h"
#include "tests/support/kitchen.h"
#include "tests/unit/robot/missions/fire/fake_motion.h"

namespace kiln {

/// Five accepted views make an estimate: the plate's true centre with a sigma of 1 cm.
class FakeHeatSweep final : public HeatSweep {
 public:
  void begin() override { views_ = 0; }
  void add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal,
           const Eigen::Vector3d& normal_prior_map) override;
  [[nodiscard]] std::optional<FireEstimate> estimate() const override;
  Eigen::Vector3d p_plate_map = Eigen::Vector3d::Zero();
  double sigma_m = 0.01;

 private:
  int views_ = 0;
  Stamp stamp_;
};

/// Says of every place what the test wants.
class FakePlaceLook final : public PlaceLook {
 public:
  explicit FakePlaceLook(const Clock& clock) : clock_(clock) {}
  void begin(const std::string& place, const Eigen::Isometry3d& X_map_front) override;
  [[nodiscard]] std::optional<PlaceCheck> answer() const override { return answer_; }

  Pose2 misplaced;      ///< of every place, from its configured pose
  bool silent = false;  ///< never answers
  int asked = 0;

 private:
  const Clock& clock_;
  std::optional<PlaceCheck> answer_;
  std::map<std::string, Eigen::Isometry3d> first_;  ///< as configured
};

/// The fire mission in the nominal kitchen with fake motion, real pump control and a plate that
/// warms as in scenario.md section 3. Everything runs under one ManualClock at 50 Hz.
class FireRig {
 public:
  struct Options {
    int burning_place = 0;  ///< -1: none
    std::string checkpoint_path{};
    bool start = true;
  };
  FireRig();
  explicit FireRig(const Options& options);

  void run(double seconds);
  /// Runs until the condition holds. @return false when it does not within `limit_s`.
  bool runUntil(const std::function<bool()>& condition, double limit_s = 900.0);
  bool runToState(const std::string& state, double limit_s = 900.0);
  bool runToEnd(double limit_s = 1500.0);
  /// kill -9 and --resume: the world stands where it was, everything in the daemon begins anew.
  void killAndResume();

  [[nodiscard]] FsmStatus status() const { return mission->machine().status(clock.now()); }
  [[nodiscard]] std::string state() const { return status().state; }
  ChangeStateResult force(const std::string& to);
  /// Names of all states that were entered since the rig was made, in order.
  [[nodiscard]] const std::vector<std::string>& visited() const { return visited_; }
  [[nodiscard]] int countVisits(const std::string& state) const;
  /// Note that the history keeps of the newest entry into a state.
  [[nodiscard]] std::string noteOf(const std::string& state) const;
  /// Where the places stand as the mission believes.
  [[nodiscard]] const FireSiteMap& site() const { return mission->siteMap(); }
  [[nodiscard]] const FirePlace& place(std::size_t i) const { return mission->belief().places[i]; }
  [[nodiscard]] bool armAt(const std::vector<double>& q_deg) const;
  [[nodiscard]] bool pumpsRun() const;
  [[nodiscard]] double missionTime() const { return belief.elapsedS(clock.now()); }

  ManualClock clock{Stamp{std::chrono::seconds(1000)}};
  ArenaMap arena = loadKitchen();
  RobotGeometry robot;
  FireConfig config;
  FakeArm arm_device;
  FakePumps pumps_device;
  FakeArmMotion arm;
  FakeBaseMotion base;
  StopLatch stop;
  FakeHeatSweep sweep;
  FakePlaceLook place_look{clock};
  std::unique_ptr<PumpController> pumps;
  RobotBelief belief;
  std::unique_ptr<FireMission> mission;
  std::unique_ptr<MissionHost> host;

  int burning_place = 0;
  std::optional<double> steady_c;  ///< the plate is so warm and stays so, degC
  bool hidden = false;             ///< something stands before the plate
  bool camera_dead = false;
  bool camera_frozen = false;
  bool drove_extended = false;  ///< the base moved while the arm was not in its drive pose
  bool pumped_while_driving = false;

 private:
  void build();
  void step();
  void takeImage();
  [[nodiscard]] bool plateInView(const Eigen::Isometry3d& X_map_thermal) const;

  Options options_;
  ManualExecutor executor_{clock};  ///< nothing is posted: detections are handed over
  SprayCalibration spray_calibration_;
  Stamp plate_lit_;
  Stamp next_image_;
  std::uint64_t image_seq_ = 0;
  std::uint64_t last_step_ = 0;
  std::vector<std::string> visited_;
};

}  // namespace kiln
