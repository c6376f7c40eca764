#include "robot/evaluation/calibration_routine.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/core/log.h"
#include "robot/perception/cloud/self_filter.h"
#include "robot/perception/thermal/heat_detector.h"
#include "robot/skills/look/search_rectangle.h"
#include "robot/skills/move_arm.h"

namespace kiln {
namespace {

constexpr double kDeg = M_PI / 180.0;
constexpr double kMotionLimit_s = 40.0, kFrameLimit_s = 3.0;

/// Van der Corput: numbers that fill (0, 1) evenly, however many are taken.
double evenly(int i, int base) {
  double out = 0.0, share = 1.0;
  for (int k = i + 1; k > 0; k /= base) {
    share /= base;
    out += share * (k % base);
  }
  return out;
}

MoveArm::Config motionConfig(const CalibrationRoutine::Config& config) {
  MoveArm::Config out;
  out.speed_scale = config.speed_scale;
  return out;
}

/// The robot was put down by eye, and so was the plate: the arm keeps away from where it may be.
ArenaMap withRoomForError(ArenaMap yard) {
  constexpr double kError_m = 0.3;
  yard.box_size_m += 2.0 * kError_m;
  yard.table_size_m += 2.0 * kError_m;
  yard.recess_m += kError_m;
  return yard;
}

double spread(int i, int base, double limit) { return limit * (2.0 * evenly(i, base) - 1.0); }

}  // namespace

struct CalibrationRoutine::Impl {
  Impl(const Config& c, const RobotGeometry& geometry, const ArenaMap& map, CalibrationDevices d)
      : config(c),
        nominal(geometry),
        yard(map),
        devices(std::move(d)),
        planned_yard(withRoomForError(map)),
        controller({}, geometry, devices.arm, stop),
        mover(motionConfig(c), nominal, planned_yard, controller, devices.arm,
              [this] { return yard.start.pose(); }) {}

  Result<void> pass(double seconds) {
    const Stamp until = devices.clock.now() + fromSeconds(seconds);
    while (devices.clock.now() < until) {
      if (auto stepped = devices.step(); !stepped) return stepped;
      controller.tick(devices.clock.now());
      if (++steps % 2 == 0) motion = mover.poll(devices.clock.now());
    }
    return {};
  }

  /// Moves there and comes to rest. Error: Refused when the arm cannot get there.
  Result<void> moveTo(const Vector6d& q) {
    mover.startJoints(q, devices.clock.now());
    const Stamp limit = devices.clock.now() + fromSeconds(kMotionLimit_s);
    do {
      if (auto passed = pass(0.04); !passed) return passed;
      if (motion.phase == SkillPhase::Failed)
        return makeError(ErrorCode::Refused, "{}", motion.text);
      if (devices.clock.now() > limit) return makeError(ErrorCode::Timeout, "the arm is not there");
    } while (motion.phase != SkillPhase::Done);
    return pass(config.settle_s);
  }

  [[nodiscard]] Result<Eigen::Isometry3d> flange() const {
    const auto state = devices.arm.state();
    if (!state) return makeError(ErrorCode::Unavailable, "the arm tells no joint angles");
    return nominal.X_base_flange(state->q);
  }

  /// The first `count` of the postures that the arm can take, in an order that makes a short way.
  [[nodiscard]] std::vector<Vector6d> reachable(
      int first, int count, const std::function<Eigen::Isometry3d(int)>& posture) const;
  /// Goes there and measures; a posture the arm cannot reach on its way is left out.
  Result<int> visit(const std::vector<Vector6d>& postures,
                    const std::function<Result<void>()>& measure);
  Result<std::vector<StillScan>> collectScans();
  Result<std::vector<PlateSighting>> collectSightings();
  Result<void> scanHere(std::vector<StillScan>& out);
  Result<void> lookHere(std::vector<PlateSighting>& out);
  Result<void> waitForHotPlate();
  Result<Extrinsics> lookAtDeck();
  [[nodiscard]] Eigen::Vector3d plateInBase() const;
  [[nodiscard]] Eigen::Vector3d normalInBase() const;

  const Config config;
  const RobotGeometry nominal;
  const ArenaMap yard;
  CalibrationDevices devices;
  const ArenaMap planned_yard;
  StopLatch stop;
  ArmController controller;
  MoveArm mover;
  SkillStatus motion;
  HeatDetector detector{{}};
  PointCloudPtr scan;
  ThermalImagePtr image;
  RgbImagePtr picture;
  int steps = 0;
};

Eigen::Vector3d CalibrationRoutine::Impl::plateInBase() const {
  const auto& p = yard.fire_places.front().plate_xyz_m;
  return toIsometry(inverse(yard.start.pose())) * Eigen::Vector3d(p[0], p[1], p[2]);
}

Eigen::Vector3d CalibrationRoutine::Impl::normalInBase() const {
  const double yaw = yard.fire_places.front().facing_deg * kDeg - yard.start.pose().yaw_rad;
  return {std::cos(yaw), std::sin(yaw), 0.0};
}

Result<void> CalibrationRoutine::Impl::scanHere(std::vector<StillScan>& out) {
  const auto X = flange();
  if (!X) return tl::make_unexpected(X.error());
  const Vector6d q = devices.arm.state()->q;
  const Stamp from = devices.clock.now();
  const SelfFilter filter(nominal, {});
  for (int i = 0; i < config.scans_a_posture; ++i) {
    scan.reset();
    const Stamp limit = devices.clock.now() + fromSeconds(kFrameLimit_s);
    while (!scan || scan->stamp < from) {
      if (auto passed = pass(0.008); !passed) return passed;
      if (devices.clock.now() > limit)
        return makeError(ErrorCode::Timeout, "no LiDAR scan; check its cable and power");
    }
    ArmTrack still;
    still.push(scan->stamp, q);
    auto filtered = filter.filter(*scan, still);
    out.push_back({std::make_shared<PointCloud>(std::move(filtered.cloud)), *X});
  }
  return {};
}

std::vector<Vector6d> CalibrationRoutine::Impl::reachable(
    int first, int count, const std::function<Eigen::Isometry3d(int)>& posture) const {
  constexpr int kTries = 8;  // a posture
  std::vector<Vector6d> found, out;
  for (int i = first; static_cast<int>(found.size()) < count && i < first + kTries * count; ++i) {
    if (const auto q = mover.check(posture(i)); q) found.push_back(*q);
  }
  const auto state = devices.arm.state();
  Vector6d here = state ? state->q : RobotGeometry::radians(nominal.q_drive_deg);
  while (!found.empty()) {
    const auto way = [&](const Vector6d& q) { return (q - here).cwiseAbs().maxCoeff(); };
    const auto nearest =
        std::min_element(found.begin(), found.end(),
                         [&](const Vector6d& a, const Vector6d& b) { return way(a) < way(b); });
    here = *nearest;
    out.push_back(here);
    found.erase(nearest);
  }
  return out;
}

Result<int> CalibrationRoutine::Impl::visit(const std::vector<Vector6d>& postures,
                                            const std::function<Result<void>()>& measure) {
  int visited = 0;
  for (const Vector6d& q : postures) {
    if (auto moved = moveTo(q); !moved) {
      if (moved.error().code != ErrorCode::Refused) return tl::make_unexpected(moved.error());
      logger("calibrate")->info("a posture is left out: {}", moved.error().message);
      continue;
    }
    if (auto measured = measure(); !measured) return tl::make_unexpected(measured.error());
    ++visited;
  }
  return visited;
}

Result<std::vector<StillScan>> CalibrationRoutine::Impl::collectScans() {
  const Eigen::Isometry3d X_drive =
      nominal.X_base_flange(RobotGeometry::radians(nominal.q_drive_deg));
  // Around the drive pose, before and above it, turned about all three axes.
  const auto posture = [&](int i) {
    Eigen::Isometry3d X = X_drive;
    X.translation() +=
        Eigen::Vector3d(0.25 + spread(i, 2, 0.3), spread(i, 3, 0.35), 0.05 + spread(i, 5, 0.25));
    X.rotate(Eigen::AngleAxisd(spread(i, 7, 100.0 * kDeg), Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(spread(i, 11, 45.0 * kDeg), Eigen::Vector3d::UnitX()) *
             Eigen::AngleAxisd(spread(i, 13, 60.0 * kDeg), Eigen::Vector3d::UnitZ()));
    return X;
  };
  std::vector<StillScan> out;
  const auto visited =
      visit(reachable(0, config.lidar_postures, posture), [&] { return scanHere(out); });
  if (!visited) return tl::make_unexpected(visited.error());
  return out;
}

Result<void> CalibrationRoutine::Impl::lookHere(std::vector<PlateSighting>& out) {
  const auto X = flange();
  if (!X) return tl::make_unexpected(X.error());
  const Stamp from = devices.clock.now();
  for (int i = 0; i < config.images_a_posture; ++i) {
    image.reset();
    const Stamp limit = devices.clock.now() + fromSeconds(kFrameLimit_s);
    while (!image || image->stamp < from) {
      if (auto passed = pass(0.008); !passed) return passed;
      if (devices.clock.now() > limit)
        return makeError(ErrorCode::Timeout, "no thermal image; check its USB cable");
    }
    const HeatDetections seen = detector.detect(*image);
    if (!seen.usable) continue;
    for (const HeatBlob& blob : seen.blobs) {
      const bool whole = blob.u_min > 1 && blob.v_min > 1 && blob.u_max < image->width - 2 &&
                         blob.v_max < image->height - 2;
      if (blob.rejection != HeatRejection::None || !whole) continue;
      out.push_back({*X, {blob.u, blob.v}});
      break;
    }
  }
  return {};
}

Result<void> CalibrationRoutine::Impl::waitForHotPlate() {
  const Stamp limit = devices.clock.now() + fromSeconds(config.plate_wait_s);
  std::vector<PlateSighting> seen;
  while (seen.empty()) {
    if (auto looked = lookHere(seen); !looked) return looked;
    if (devices.clock.now() > limit)
      return makeError(
          ErrorCode::NotFound,
          "no plate hotter than {:.0f} degC before the robot; heat it, or put the robot "
          "before it as the yard's map says",
          config.plate_threshold_c);
  }
  return {};
}

Result<std::vector<PlateSighting>> CalibrationRoutine::Impl::collectSightings() {
  const Eigen::Isometry3d X_thermal_flange = nominal.X_flange_thermal.pose().inverse();
  const Eigen::Vector3d normal = normalInBase();
  Eigen::Vector3d plate = plateInBase();
  const auto look = [&](int i) {
    const double bearing = spread(i, 2, 14.0 * kDeg), height = spread(i, 3, 12.0 * kDeg);
    const double range = 0.95 + spread(i, 5, 0.18), roll = spread(i, 7, 75.0 * kDeg);
    const Eigen::Vector3d sideways = Eigen::Vector3d::UnitZ().cross(normal);
    const Eigen::Vector3d from = plate + range * (normal + std::tan(bearing) * sideways +
                                                  std::tan(height) * Eigen::Vector3d::UnitZ())
                                                     .normalized();
    // The plate wanders over the picture, not only its middle.
    const Eigen::Vector3d target =
        plate + spread(i, 11, 0.12) * sideways + spread(i, 13, 0.08) * Eigen::Vector3d::UnitZ();
    return lookAt(from, target) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) *
           X_thermal_flange;
  };
  constexpr int kRough = 6;
  std::vector<PlateSighting> out;
  bool hot = false;
  const auto measure = [&]() -> Result<void> {
    if (!hot) {
      if (auto waited = waitForHotPlate(); !waited) return waited;
      hot = true;
    }
    return lookHere(out);
  };
  const auto begun = visit(reachable(0, kRough, look), measure);
  if (!begun) return tl::make_unexpected(begun.error());
  // Where the plate really is, so that it stays in the picture.
  ThermalCalibrator::Config rough = config.thermal;
  rough.min_sightings = kRough;
  if (const auto found =
          ThermalCalibrator(rough).calibrate(out, nominal.X_flange_thermal.pose(), plate, normal))
    plate = found->p_base_plate;
  const auto visited =
      visit(reachable(8 * kRough, config.thermal_postures - kRough, look), measure);
  if (!visited) return tl::make_unexpected(visited.error());
  return out;
}

/// @pre the arm is at rest.
Result<Extrinsics> CalibrationRoutine::Impl::lookAtDeck() {
  if (auto on = devices.operator_camera.start([this](RgbImagePtr p) { picture = std::move(p); });
      !on)
    return tl::make_unexpected(on.error());
  const Stamp limit = devices.clock.now() + fromSeconds(kFrameLimit_s);
  while (!picture) {
    if (auto passed = pass(0.008); !passed) return tl::make_unexpected(passed.error());
    if (devices.clock.now() > limit)
      return makeError(ErrorCode::Timeout, "no picture of the operator camera; check its cable");
  }
  devices.operator_camera.stop();
  const auto state = devices.arm.state();
  if (!state) return makeError(ErrorCode::Unavailable, "the arm tells no joint angles");
  return CameraCalibrator(config.camera)
      .calibrate(*picture, nominal, state->q, nominal.X_base_operatorcamera.pose());
}

CalibrationRoutine::CalibrationRoutine(const Config& config, const RobotGeometry& nominal,
                                       const ArenaMap& yard, CalibrationDevices devices)
    : impl_(std::make_unique<Impl>(config, nominal, yard, std::move(devices))) {}
CalibrationRoutine::~CalibrationRoutine() = default;

namespace {

std::string line(const char* what, const Extrinsics& found, const PoseConfig& nominal) {
  const ExtrinsicDifference off = difference(nominal.pose(), found.X_parent_sensor);
  const bool metres = found.unit == "m";
  return fmt::format(
      "{}: {:.1f} mm and {:.2f} deg off nominal; residuals {:.2f} -> {:.2f} {} rms over {} "
      "measurements from {} views; 1 sigma {:.1f} mm, {:.3f} deg",
      what, 1e3 * off.translation_m, off.rotation_rad / kDeg,
      metres ? 1e3 * found.rms_before : found.rms_before,
      metres ? 1e3 * found.rms_after : found.rms_after, metres ? "mm" : found.unit.c_str(),
      found.measurements, found.views, 1e3 * found.sigma_m.maxCoeff(),
      found.sigma_rad.maxCoeff() / kDeg);
}

/// What a robot would believe of it; error: what it would not.
Result<CalibrationResult> summed(const RobotGeometry& nominal, const LidarCalibration& lidar,
                                 const ThermalCalibration& thermal,
                                 const Result<Extrinsics>& camera) {
  CalibrationResult out{lidar, thermal, std::nullopt, RobotCalibration::of(nominal), {}};
  RobotCalibration& found = out.calibration;
  found.X_flange_lidar = poseConfig(lidar.flange_lidar.X_parent_sensor);
  found.X_flange_thermal = poseConfig(thermal.flange_thermal.X_parent_sensor);
  found.lidar_range_bias_m.assign(lidar.range_bias_m.begin(), lidar.range_bias_m.end());
  if (auto believed = found.applyTo(nominal); !believed)
    return tl::make_unexpected(believed.error());
  std::string camera_line;
  if (camera) {
    const PoseConfig before =
        std::exchange(found.X_base_operatorcamera, poseConfig(camera->X_parent_sensor));
    camera_line = line("operator camera", *camera, nominal.X_base_operatorcamera);
    if (const auto believed = found.applyTo(nominal); believed) {
      out.operator_camera = *camera;
    } else {  // shows pictures, steers nothing: the others need not wait for it
      found.X_base_operatorcamera = before;
      camera_line = "operator camera: stays nominal; " + believed.error().message;
    }
  } else {
    camera_line = "operator camera: stays nominal; " + camera.error().message;
  }
  out.report = {line("LiDAR", lidar.flange_lidar, nominal.X_flange_lidar),
                line("thermal camera", thermal.flange_thermal, nominal.X_flange_thermal),
                camera_line, "nozzle: not observable, no sensor on board sees it; stays nominal"};
  return out;
}

}  // namespace

Result<CalibrationResult> CalibrationRoutine::run() {
  Impl& m = *impl_;
  if (m.yard.fire_places.empty())
    return makeError(ErrorCode::InvalidInput, "the yard's map has no hot plate (fire_places)");
  if (auto on = m.devices.lidar.start([&m](PointCloudPtr s) { m.scan = std::move(s); }); !on)
    return tl::make_unexpected(on.error());
  if (auto on = m.devices.thermal.start([&m](ThermalImagePtr i) { m.image = std::move(i); }); !on)
    return tl::make_unexpected(on.error());
  if (auto passed = m.pass(0.5); !passed) return tl::make_unexpected(passed.error());

  const auto camera = m.lookAtDeck();
  auto scans = m.collectScans();
  if (!scans) return tl::make_unexpected(scans.error());
  logger("calibrate")
      ->info("{} scans taken in {:.0f} s", scans->size(), toSeconds(m.devices.clock.now()));
  auto lidar = LidarCalibrator(m.config.lidar).calibrate(*scans, m.nominal.X_flange_lidar.pose());
  if (!lidar) return tl::make_unexpected(lidar.error());
  auto sightings = m.collectSightings();
  if (!sightings) return tl::make_unexpected(sightings.error());
  logger("calibrate")
      ->info("the hot plate was seen {} times; {:.0f} s", sightings->size(),
             toSeconds(m.devices.clock.now()));
  auto thermal = ThermalCalibrator(m.config.thermal)
                     .calibrate(*sightings, m.nominal.X_flange_thermal.pose(), m.plateInBase(),
                                m.normalInBase());
  if (!thermal) return tl::make_unexpected(thermal.error());

  return summed(m.nominal, *lidar, *thermal, camera);
}

}  // namespace kiln
