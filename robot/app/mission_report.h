#pragma once

#include <string>
#include <vector>

#include "common/core/error.h"
#include "common/geom/pose.h"
#include "common/model/fire.h"
#include "common/model/fsm.h"
#include "common/model/place_check.h"

namespace kiln {

/// What the robot says of its mission afterwards. Deterministic in lockstep: robot time only.
class MissionReport {
 public:
  MissionReport(std::string mission, Stamp start) : mission_(std::move(mission)), start_(start) {}

  /// Call once a tick: picks up every transition from the bounded history.
  void observe(const FsmStatus& status);
  struct HeatRecord {
    Stamp stamp;                ///< of the last image in the estimate
    Eigen::Vector3d p_thermal;  ///< estimate in the believed camera frame at that stamp, m
    double range_m = 0.0, baseline_range_m = 0.0;
    int views = 0;
    std::string place;
  };
  void addHeatEstimate(const HeatRecord& record);
  /// Where the robot believed to be, five times a second.
  struct TrackRecord {
    Stamp stamp;
    Pose2 X_map_base;
    Pose2 X_odom_base;  ///< wheel odometry alone
    bool located = false;
    bool indoor = false;  ///< map in use
  };
  void addTrack(const TrackRecord& record);
  /// Configured against sensed; each answer once.
  void addPlaceCheck(const PlaceCheck& check);
  void setTotals(double litres_est, int resets) {
    litres_est_ = litres_est;
    resets_ = resets;
  }
  [[nodiscard]] std::string toJson(Stamp now) const;
  /// @return Storage error if the disk refuses.
  [[nodiscard]] Result<void> write(const std::string& path, Stamp now) const;

 private:
  std::string mission_;
  Stamp start_;
  std::vector<FsmHistoryEntry> states_;
  std::vector<HeatRecord> heat_;
  std::vector<TrackRecord> track_;
  std::vector<int> track_resets_;  ///< of each record
  std::vector<PlaceCheck> checks_;
  FsmStatus last_;
  double litres_est_ = 0.0;
  int resets_ = 0;
};

}  // namespace kiln
