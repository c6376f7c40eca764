#include "robot/app/sensor_intake.h"

#include <array>
#include <utility>

#include "common/core/log.h"
#include "common/geom/frames.h"
#include "robot/app/run_recorder.h"

namespace kiln {
namespace {

void warnIfFailed(const Result<void>& started) {
  if (!started) logger("robot")->error("{}", started.error().message);
}

}  // namespace

SensorIntake::SensorIntake(RobotBody& body, const ScanLocator& locator, Executor& executor)
    : body_(body),
      self_filter_(body.robot, body.settings.self_filter),
      perception_(body.settings.perception, executor, body.robot, history_, self_filter_, locator,
                  body.settings.surroundings.obstacles),
      surroundings_(body.settings.surroundings) {}

void SensorIntake::start(std::function<void(ThermalImagePtr)> thermal,
                         std::function<void(RgbImagePtr)> picture) {
  picture_ = std::move(picture);
  body_.drive.setSurroundings(&surroundings_);
  body_.move_arm.setSurroundings(&surroundings_);
  const Devices& devices = body_.devices;
  if (devices.lidar)
    warnIfFailed(devices.lidar->start([this](PointCloudPtr scan) {
      if (body_.options.recorder) body_.options.recorder->scan(scan);
      perception_.onScan(std::move(scan));
    }));
  if (devices.thermal) warnIfFailed(devices.thermal->start(std::move(thermal)));
}

void SensorIntake::stop() {
  if (body_.devices.lidar) body_.devices.lidar->stop();
  if (body_.devices.thermal) body_.devices.thermal->stop();
  for (RgbCamera* camera : {body_.devices.operator_camera, body_.devices.head_camera})
    if (camera) camera->stop();
}

void SensorIntake::remember(const std::optional<BaseState>& wheels, const Pose2& X_odom_base) {
  const auto arm_state = body_.devices.arm.state();
  if (arm_state) history_.addJoints(arm_state->stamp, arm_state->q);
  if (wheels) history_.addOdometry(wheels->stamp, X_odom_base);
}

void SensorIntake::forget() {
  history_.clear();
  surroundings_.clear();
}

void SensorIntake::place(PerceptionJobs::ScanResult& result, const TrackedPose& tracked) {
  const auto sample = history_.at(result.cloud->stamp);
  if (!sample || !result.obstacles) return;
  // Height and tilt are those of now, a tenth of a second later.
  const Eigen::Isometry3d X_plane_base =
      toIsometry(tracked.X_map_base).inverse() * tracked.X_map_base_3d;
  surroundings_.add({result.cloud, std::move(*result.obstacles), sample->X_odom_base,
                     toIsometry(tracked.X_map_odom * sample->X_odom_base) * X_plane_base,
                     std::move(result.lidar_track)});
}

std::optional<BodyPose> SensorIntake::bodyAt(Stamp stamp, const TrackedPose& tracked) const {
  const auto sample = history_.at(stamp);
  if (!sample) return std::nullopt;
  return BodyPose{sample->X_odom_base, tracked.X_map_odom * sample->X_odom_base,
                  body_.robot.X_base_flange(sample->q)};
}

std::optional<Eigen::Isometry3d> SensorIntake::flangeAt(Stamp stamp,
                                                        const TrackedPose& tracked) const {
  const auto body = bodyAt(stamp, tracked);
  if (!body) return std::nullopt;
  return toIsometry(body->X_map_base) * body->X_base_flange;
}

void SensorIntake::runCameraOnDemand(OperatorLink* link, bool mission_looks) {
  const std::array cameras{std::pair{body_.devices.operator_camera, frames::kOperatorCamera},
                           std::pair{body_.devices.head_camera, frames::kRgb}};
  if (!cameras[0].first && !cameras[1].first) return;
  const RunRecorder* recorder = body_.options.recorder;
  if (recorder && link) link->keepPictures(recorder->config().pictures && recorder->on());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto& [camera, frame] = cameras[i];
    if (!camera) continue;
    const bool wanted =
        (link && link->wanted(frame)) || (mission_looks && camera == body_.devices.head_camera);
    if (wanted == camera_runs_[i]) continue;
    camera_runs_[i] = wanted;
    if (wanted)
      warnIfFailed(camera->start(picture_));
    else
      camera->stop();
  }
}

}  // namespace kiln
