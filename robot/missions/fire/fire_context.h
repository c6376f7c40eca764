#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "robot/missions/common/mission_parts.h"
#include "robot/missions/common/stowed_drive.h"
#include "robot/missions/fire/fire_belief.h"
#include "robot/missions/fire/fire_config.h"
#include "robot/missions/fire/skills/heat_watch.h"
#include "robot/missions/fire/skills/look_around.h"
#include "robot/missions/fire/skills/place_look.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {

/// What the fire mission works with; all outlive it.
struct FireDevices : MissionParts {
  HeatSweep& heat;        ///< HeatLocalizer behind an adapter
  PlaceLook& place_look;  ///< PlaceTask
  FireSiteMap site;       ///< as configured
  SprayCalibration calibration;
};

/// What the states of the fire mission share. Confined to the mission thread.
class FireContext {
 public:
  FireContext(const FireDevices& devices, const FireConfig& fire_config);

  const FireDevices devices;
  const FireConfig config;
  const SprayCalibration& calibration = devices.calibration;
  FireSiteMap site;  ///< where everything is believed to stand now
  FireBelief belief;
  HeatWatch heat;
  WarmingTrend warming;  ///< of the present sweep
  LookAround look;
  StowedDrive drive;
  /// The chosen spray pose, seen from where the base stood then: a later correction of the base's
  /// pose in map does not move the nozzle. Not kept over a restart: aiming starts anew.
  struct Aim {
    AimSolution solution;
    Pose2 X_map_base;
    [[nodiscard]] Eigen::Isometry3d X_base_nozzle() const {
      return toIsometry(X_map_base).inverse() * solution.X_map_nozzle;
    }
  };
  std::optional<Aim> aim;
  std::optional<PlaceCheck> place_check;           ///< of the present look
  std::map<std::string, PlaceCheck> place_checks;  ///< newest of each place
  std::optional<Stamp> pumps_idle_since;           ///< while they should run

  /// Seconds on the mission clock.
  [[nodiscard]] double elapsedS(Stamp now) const { return devices.belief.elapsedS(now); }
  /// @pre a place is selected.
  [[nodiscard]] FirePlace& place();
  [[nodiscard]] const FirePlace& place() const;
  [[nodiscard]] bool hasPlace() const { return belief.currentPlace() != nullptr; }
  /// What is known of a place has moved it: site and arena follow.
  void placeMoved(std::size_t index);
  /// Where the current place's front is believed to be.
  [[nodiscard]] Eigen::Isometry3d placeFront() const;
  /// For State::denyEntry.
  [[nodiscard]] std::string whyNoPlace() const;
  /// Done with the current place in this round.
  void closePlace(const std::string& outcome);

  [[nodiscard]] Eigen::Isometry3d X_map_base() const;
  [[nodiscard]] std::optional<Eigen::Isometry3d> X_base_flange()
      const;  ///< nullopt without an arm state
  [[nodiscard]] std::optional<Eigen::Isometry3d> X_map_nozzle() const;
  [[nodiscard]] Eigen::Isometry3d flangeForNozzleInBase(
      const Eigen::Isometry3d& X_base_nozzle) const;  ///< X_base_flange
  /// X_base_flange for a nozzle pose in base.
  [[nodiscard]] Eigen::Isometry3d flangeFor(const Eigen::Isometry3d& X_base_nozzle) const;
  [[nodiscard]] Eigen::Isometry3d flangeForNozzle(
      const Eigen::Isometry3d& X_map_nozzle) const;   ///< X_base_flange
  [[nodiscard]] Eigen::Vector3d placeNormal() const;  ///< of the current place, in map
  /// Newest estimate of the present sweep, else the one that is remembered for the place; gated to
  /// the place.
  [[nodiscard]] std::optional<FireEstimate> estimate();
  [[nodiscard]] AimTarget aimTarget(const FireEstimate& estimate) const;
  /// Expected flow by full flow, in the middle of the water that is still to be sprayed here.
  [[nodiscard]] double flowScale() const;
  /// The nozzle is where it was aimed, and the base was not driven since.
  [[nodiscard]] bool atSprayPose() const;
  [[nodiscard]] bool atWorkPose() const;

  /// Feeds the pumps for 200 ms; to be called at each step of a spraying state.
  void pumpsOn(Stamp now) const;
  void pumpsOff(Stamp now) const;
  /// Arm and base come to rest.
  void haltMotion();
  void haltAll(Stamp now);
};

}  // namespace kiln
