#include "robot/evaluation/calibration_routine.h"

#include <cmath>
#include <optional>

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

double spread(int i, int base, double limit) { return limit * (2.0 * evenly(i, base) - 1.0); }

}  // namespace

struct CalibrationRoutine::Impl {
  Impl(const Config& c, const RobotGeometry& geometry, const ArenaMap& map, CalibrationDevices d)
      : config(c),
        nominal(geometry),
        yard(map),
        devices(std::move(d)),
        controller({}, geometry, devices.arm, stop),
        mover({}, nominal, yard, controller, devices.arm, [this] { return yard.start.pose(); }) {}

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
  Result<void> moveTo(const Eigen::Isometry3d& X_base_flange) {
    mover.startPose(X_base_flange, devices.clock.now());
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

  Result<std::vector<StillScan>> collectScans();
  Result<std::vector<PlateSighting>> collectSightings(const Eigen::Isometry3d& X_flange_lidar);
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

Result<std::vector<StillScan>> CalibrationRoutine::Impl::collectScans() {
  std::vector<StillScan> out;
  const Eigen::Isometry3d X_drive =
      nominal.X_base_flange(RobotGeometry::radians(nominal.q_drive_deg));
  int postures = 0;
  for (int i = 0; postures < config.lidar_postures && i < 8 * config.lidar_postures; ++i) {
    // Around the drive pose, before and above it, turned about all three axes.
    Eigen::Isometry3d X = X_drive;
    X.translation() +=
        Eigen::Vector3d(0.25 + spread(i, 2, 0.3), spread(i, 3, 0.35), 0.05 + spread(i, 5, 0.25));
    X.rotate(Eigen::AngleAxisd(spread(i, 7, 100.0 * kDeg), Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(spread(i, 11, 45.0 * kDeg), Eigen::Vector3d::UnitX()) *
             Eigen::AngleAxisd(spread(i, 13, 60.0 * kDeg), Eigen::Vector3d::UnitZ()));
    if (!mover.check(X)) continue;
    if (auto moved = moveTo(X); !moved) {
      if (moved.error().code == ErrorCode::Refused) continue;
      return tl::make_unexpected(moved.error());
    }
    if (auto scanned = scanHere(out); !scanned) return tl::make_unexpected(scanned.error());
    ++postures;
  }
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

Result<std::vector<PlateSighting>> CalibrationRoutine::Impl::collectSightings(
    const Eigen::Isometry3d& X_flange_lidar) {
  (void)X_flange_lidar;
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
  std::vector<PlateSighting> out;
  int postures = 0;
  bool hot = false;
  for (int i = 0; postures < config.thermal_postures && i < 8 * config.thermal_postures; ++i) {
    const Eigen::Isometry3d X = look(i);
    if (!mover.check(X)) continue;
    if (auto moved = moveTo(X); !moved) {
      if (moved.error().code == ErrorCode::Refused) continue;
      return tl::make_unexpected(moved.error());
    }
    if (!hot) {
      if (auto waited = waitForHotPlate(); !waited) return tl::make_unexpected(waited.error());
      hot = true;
    }
    if (auto looked = lookHere(out); !looked) return tl::make_unexpected(looked.error());
    ++postures;
    if (postures == 6) {  // where the plate really is, so that it stays in the picture
      ThermalCalibrator::Config rough = config.thermal;
      rough.min_sightings = 6;
      const auto found =
          ThermalCalibrator(rough).calibrate(out, nominal.X_flange_thermal.pose(), plate, normal);
      if (found) plate = found->p_base_plate;
    }
  }
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
  logger("calibrate")->info("{} scans taken", scans->size());
  auto lidar = LidarCalibrator(m.config.lidar).calibrate(*scans, m.nominal.X_flange_lidar.pose());
  if (!lidar) return tl::make_unexpected(lidar.error());
  auto sightings = m.collectSightings(lidar->flange_lidar.X_parent_sensor);
  if (!sightings) return tl::make_unexpected(sightings.error());
  logger("calibrate")->info("the hot plate was seen {} times", sightings->size());
  auto thermal = ThermalCalibrator(m.config.thermal)
                     .calibrate(*sightings, m.nominal.X_flange_thermal.pose(), m.plateInBase(),
                                m.normalInBase());
  if (!thermal) return tl::make_unexpected(thermal.error());

  CalibrationResult out{*lidar, *thermal, std::nullopt, RobotCalibration::of(m.nominal), {}};
  out.calibration.X_flange_lidar = poseConfig(lidar->flange_lidar.X_parent_sensor);
  out.calibration.X_flange_thermal = poseConfig(thermal->flange_thermal.X_parent_sensor);
  out.calibration.lidar_range_bias_m.assign(lidar->range_bias_m.begin(), lidar->range_bias_m.end());
  out.report = {line("LiDAR", lidar->flange_lidar, m.nominal.X_flange_lidar),
                line("thermal camera", thermal->flange_thermal, m.nominal.X_flange_thermal),
                camera ? line("operator camera", *camera, m.nominal.X_base_operatorcamera)
                       : "operator camera: stays nominal; " + camera.error().message,
                "nozzle: not observable, no sensor on board sees it; stays nominal"};
  if (camera) {
    out.operator_camera = *camera;
    out.calibration.X_base_operatorcamera = poseConfig(camera->X_parent_sensor);
  }
  return out;
}

}  // namespace kiln
