#pragma once

#include <string>
#include <vector>

#include "common/geom/pose.h"
#include "robot/missions/common/mission_host.h"

namespace kiln {

/// What the robot says of its mission afterwards: the host's log, its track, and what the mission
/// adds. Deterministic in lockstep: robot time only.
class MissionReport {
 public:
  /// @param created  counts as the start of a mission that never began.
  explicit MissionReport(Stamp created) : created_(created) {}

  /// Another mission: its track begins anew.
  void begin() { track_.clear(); }
  /// Where the robot believed to be, five times a second.
  struct TrackRecord {
    Stamp stamp;
    Pose2 X_map_base;
    Pose2 X_odom_base;  ///< wheel odometry alone
    bool located = false;
    bool indoor = false;  ///< map in use
    int resets = 0;       ///< before it
  };
  void addTrack(const TrackRecord& record);
  [[nodiscard]] std::string toJson(const MissionHost& host, int resets, Stamp now) const;

 private:
  Stamp created_;
  std::vector<TrackRecord> track_;
};

}  // namespace kiln
