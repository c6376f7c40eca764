#pragma once

#include <string>
#include <vector>

#include "robot/app/localization_settings.h"
#include "robot/app/perception_jobs.h"
#include "robot/app/preflight.h"
#include "robot/app/robot_body.h"
#include "robot/safety/motion_watch.h"

namespace kiln {

/// Where the robot is, whether anybody knows, and whether the base goes where it is told. Confined
/// to the mission thread.
class RobotLocalization {
 public:
  RobotLocalization(RobotBody& body, Location location);

  /// The robot stands there: the operator's word, or how a run begins.
  void reset(const Pose2& X_map_base, Stamp now);
  /// The devices say that it was carried to its start.
  void carriedToStart(Stamp now);
  void addOdometry(Stamp now);
  void addMatch(const PerceptionJobs::ScanResult& result);
  void update(Stamp now) { tracked_ = localizer_.pose(now); }
  /// Why a mission may not go on from here, in words; empty: it may. After a reset the first scans
  /// decide.
  [[nodiscard]] std::string objection(Stamp now);
  /// The base must do what it is told, and go where localization says: else the software STOP.
  void monitorMotion(Stamp now);

  [[nodiscard]] const TrackedPose& tracked() const { return tracked_; }
  [[nodiscard]] Pose2 pose() const { return tracked_.X_map_base; }
  [[nodiscard]] bool located() const { return tracked_.health != PoseHealth::Lost; }
  /// Why nobody knows where the robot is, in words; empty: it is known.
  [[nodiscard]] std::string lostReason() const;
  [[nodiscard]] bool indoor() const { return localizer_.submap() == Submap::Indoor; }
  [[nodiscard]] LocalizationStatus status() const;
  [[nodiscard]] Localizer& localizer() { return localizer_; }
  [[nodiscard]] const ScanLocator& locator() const { return *locator_; }
  [[nodiscard]] const std::shared_ptr<const MapLayer>& mapLayer() const { return map_layer_; }
  /// What the map makes of the scans, for the preflight.
  [[nodiscard]] const std::optional<MapFit>& mapFit() const { return map_fit_; }
  [[nodiscard]] const std::string& matchFailure() const { return match_failure_; }
  /// Wall time of each scan that was matched, s.
  [[nodiscard]] const std::vector<float>& matchCosts() const { return match_costs_; }

 private:
  void forgetMatch();

  RobotBody& body_;
  std::unique_ptr<ScanLocator> locator_;
  std::shared_ptr<const MapLayer> map_layer_;
  Localizer localizer_;
  MotionWatch motion_watch_;
  TrackedPose tracked_;
  std::optional<Stamp> carried_;  ///< the last reset, until the first scan has been matched
  std::optional<MapFit> map_fit_;
  std::string match_failure_;
  std::vector<float> match_costs_;
};

}  // namespace kiln
