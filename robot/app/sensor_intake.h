#pragma once

#include <array>
#include <functional>

#include "robot/app/live_surroundings.h"
#include "robot/app/perception_jobs.h"
#include "robot/app/robot_body.h"
#include "robot/app/state_history.h"
#include "robot/missions/common/mission_parts.h"

namespace kiln {

/// Takes what the sensors deliver and has perception work on it: motion-compensated clouds, what
/// stands around, pictures on demand. Confined to the mission thread, remember() (control thread)
/// and the sinks aside.
class SensorIntake {
 public:
  /// @param locator  outlives this.
  SensorIntake(RobotBody& body, const ScanLocator& locator, Executor& executor);

  /// Sensors begin. A device that does not start is a line in the log and a failing preflight
  /// check, not an end. @param thermal, picture  any thread.
  void start(std::function<void(ThermalImagePtr)> thermal,
             std::function<void(RgbImagePtr)> picture);
  void stop();
  /// Joints now, and the odometry that was made of `wheels`, to place sensor frames by.
  void remember(const std::optional<BaseState>& wheels, const Pose2& X_odom_base);
  /// The robot was carried: nothing that was seen fits any more.
  void forget();

  void dispatch(Stamp now, Localizer& localizer) {
    perception_.dispatch(now, localizer, !body_.base.tracking().at_rest);
  }
  [[nodiscard]] std::vector<PerceptionJobs::ScanResult> takeScans() {
    return perception_.takeScans();
  }
  /// Remembers the scan's obstacles where the robot was then.
  void place(PerceptionJobs::ScanResult& result, const TrackedPose& tracked);
  void tick() { surroundings_.tick(body_.base.tracking().X_odom_base); }
  /// Pictures cost the robot and the link more than everything else together: taken only while
  /// somebody watches, or the mission looks through the head camera.
  void runCameraOnDemand(OperatorLink* link, bool mission_looks);

  /// Where the flange was in map at a stamp of the last seconds.
  [[nodiscard]] std::optional<Eigen::Isometry3d> flangeAt(Stamp stamp,
                                                          const TrackedPose& tracked) const;
  [[nodiscard]] std::optional<BodyPose> bodyAt(Stamp stamp, const TrackedPose& tracked) const;
  [[nodiscard]] const PerceptionJobs& perception() const { return perception_; }
  [[nodiscard]] LiveSurroundings& surroundings() { return surroundings_; }

 private:
  RobotBody& body_;
  StateHistory history_;
  SelfFilter self_filter_;
  PerceptionJobs perception_;
  LiveSurroundings surroundings_;
  std::function<void(RgbImagePtr)> picture_;
  std::array<bool, 2> camera_runs_{};  ///< operator camera, head camera
};

}  // namespace kiln
