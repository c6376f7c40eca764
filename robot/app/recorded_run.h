#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/record/player.h"
#include "robot/app/devices.h"

namespace kiln {

/// The devices of a recorded run (kiln-robotd --record) as if they were there: LiDAR, thermal
/// camera, operator camera, joints, wheels and pumps as they were measured. Perception and
/// localisation then run again on old data through the same seams as live. A recording cannot be
/// moved: commands are taken and have no effect. Confined to the thread that plays it.
class RecordedRun {
 public:
  /// Error: as RecordReader::open; InvalidInput when no devices or scans are in it.
  [[nodiscard]] static Result<std::unique_ptr<RecordedRun>> open(const std::string& path,
                                                                 const Clock& wall);
  ~RecordedRun();
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  [[nodiscard]] Devices devices();
  /// Where that run's localisation had the robot at the beginning; nullopt if it was not told.
  [[nodiscard]] std::optional<Pose2> startPose() const;
  [[nodiscard]] Player& player();
  /// Hands one message to its device. Error: InvalidInput, the message cannot be read.
  Result<void> deliver(const RecordedMessage& message);

 private:
  struct Impl;
  explicit RecordedRun(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
