#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "robot/app/mission_report.h"
#include "robot/app/robot_body.h"
#include "robot/missions/common/mission_host.h"
#include "robot/missions/common/mission_parts.h"

namespace kiln {

/// The one mission of this run, its host and its report. Confined to the mission thread, ended()
/// and succeeded() aside.
class RobotMission {
 public:
  explicit RobotMission(RobotBody& body) : body_(body), report_(body.clock.now()) {}

  /// The mission that the options name, lent `parts`. Before anything below is called. Error: there
  /// is no such mission, or what it says of its configuration or arena.
  [[nodiscard]] Result<void> make(const MissionParts& parts);
  /// Goes on from the checkpoint; moves and starts nothing.
  [[nodiscard]] Result<void> resume();
  /// Whether a mission has begun since this was asked last: its report begins then.
  [[nodiscard]] bool takeBegun();
  void beginReport();
  void addTrack(const MissionReport::TrackRecord& record) { report_.addTrack(record); }
  /// Notices the mission's end.
  void update();

  [[nodiscard]] Mission& mission() const { return *mission_; }
  [[nodiscard]] MissionHost& host() const { return *host_; }
  /// What it brings, for the stations and the gate.
  [[nodiscard]] const MissionInfo& info() const { return info_; }
  /// What it needs and this robot has not.
  [[nodiscard]] const DeviceSet& lacking() const { return lacking_; }
  [[nodiscard]] bool ended() const { return ended_.load(); }
  [[nodiscard]] bool succeeded() const { return succeeded_.load(); }
  [[nodiscard]] std::string reportJson(Stamp now) const {
    return report_.toJson(*host_, body_.belief.resets, now);
  }

 private:
  [[nodiscard]] std::string checkpointPath() const;

  RobotBody& body_;
  DeviceSet lacking_;
  std::unique_ptr<Mission> mission_;
  std::unique_ptr<MissionHost> host_;
  MissionInfo info_;
  MissionReport report_;
  int starts_seen_ = 0;
  std::atomic<bool> ended_{false}, succeeded_{false};
};

}  // namespace kiln
