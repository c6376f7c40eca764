#include "robot/evaluation/calibration/thermal_part.h"

#include <cmath>

#include "common/core/log.h"
#include "common/core/units.h"
#include "robot/missions/fire/skills/search_rectangle.h"
#include "robot/perception/thermal/heat_detector.h"

namespace kiln {
namespace {

class PlateWatch {
 public:
  PlateWatch(CalibrationRig& rig, const ThermalPartConfig& config) : rig_(rig), config_(config) {
    const FirePlaceConfig& place = rig.plate();
    const auto& p = place.plate_xyz_m;
    plate_ = rig.X_base_map() * Eigen::Vector3d(p[0], p[1], p[2]);
    const double yaw = place.facing_deg * kDeg - rig.yard().start.pose().yaw_rad;
    normal_ = {std::cos(yaw), std::sin(yaw), 0.0};
  }

  Result<ThermalCalibration> calibrate();

 private:
  [[nodiscard]] Eigen::Isometry3d posture(int i, const Eigen::Vector3d& plate) const;
  Result<void> look();
  Result<void> lookOnceHot();
  Result<void> lookFrom(int first, int count, const Eigen::Vector3d& plate);

  CalibrationRig& rig_;
  const ThermalPartConfig& config_;
  Eigen::Vector3d plate_, normal_;  ///< in base, where they are thought to be
  HeatDetector detector_{{}};
  std::vector<PlateSighting> seen_;
};

/// The plate wanders over the picture, not only its middle; the head rolls.
Eigen::Isometry3d PlateWatch::posture(int i, const Eigen::Vector3d& plate) const {
  const double bearing = spread(i, 2, 14.0 * kDeg), height = spread(i, 3, 12.0 * kDeg);
  const double range = 0.95 + spread(i, 5, 0.18), roll = spread(i, 7, 75.0 * kDeg);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), sideways = up.cross(normal_);
  const Eigen::Vector3d from =
      plate + range * (normal_ + std::tan(bearing) * sideways + std::tan(height) * up).normalized();
  const Eigen::Vector3d target = plate + spread(i, 11, 0.12) * sideways + spread(i, 13, 0.08) * up;
  return lookAt(from, target) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) *
         rig_.nominal().X_flange_thermal.pose().inverse();
}

Result<void> PlateWatch::look() {
  const auto X = rig_.flange();
  if (!X) return tl::make_unexpected(X.error());
  for (int i = 0; i < config_.images_a_posture; ++i) {
    const auto image = rig_.nextImage();
    if (!image) return tl::make_unexpected(image.error());
    const HeatDetections heat = detector_.detect(**image);
    if (!heat.usable) continue;
    for (const HeatBlob& blob : heat.blobs) {
      const bool whole = blob.u_min > 1 && blob.v_min > 1 && blob.u_max < (*image)->width - 2 &&
                         blob.v_max < (*image)->height - 2;
      if (blob.rejection != HeatRejection::None || !whole) continue;
      seen_.push_back({*X, {blob.u, blob.v}});
      break;
    }
  }
  return {};
}

Result<void> PlateWatch::lookOnceHot() {
  const Stamp limit = rig_.clock().now() + fromSeconds(config_.plate_wait_s);
  const bool first = seen_.empty();
  do {
    if (auto looked = look(); !looked) return looked;
    if (rig_.clock().now() > limit)
      return makeError(ErrorCode::NotFound,
                       "no plate hotter than {:.0f} degC before the robot; heat it, or put the "
                       "robot before it as the yard's map says",
                       HeatDetector::Config{}.threshold_c);
  } while (first && seen_.empty());
  return {};
}

Result<void> PlateWatch::lookFrom(int first, int count, const Eigen::Vector3d& plate) {
  const auto postures = rig_.reachable(first, count, [&](int i) { return posture(i, plate); });
  const auto visited = rig_.visit(postures, [this] { return lookOnceHot(); });
  if (!visited) return tl::make_unexpected(visited.error());
  logger("calibrate")
      ->info("the hot plate was seen {} times, after {} of {} postures", seen_.size(), *visited,
             count);
  return {};
}

/// The robot was put down by eye: a guess of the plate's place from the first sightings lets the
/// others look where it is. Where few saw it, some more look with the better guess.
Result<ThermalCalibration> PlateWatch::calibrate() {
  constexpr int kRough = 6, kTries = 8 * kRough, kMoreRounds = 3;
  const Eigen::Isometry3d mount = rig_.nominal().X_flange_thermal.pose();
  ThermalCalibrator::Config rough = config_.calibrator;
  rough.min_sightings = 4;
  const auto wanted = static_cast<std::size_t>(config_.postures * config_.images_a_posture / 2);
  if (auto begun = lookFrom(0, kRough, plate_); !begun) return tl::make_unexpected(begun.error());
  int first = kTries, count = config_.postures - kRough;
  for (int round = 0; round <= kMoreRounds; ++round) {
    const auto guess = ThermalCalibrator(rough).calibrate(seen_, mount, plate_, normal_);
    const Eigen::Vector3d plate = guess ? guess->p_base_plate : plate_;
    if (auto looked = lookFrom(first, count, plate); !looked)
      return tl::make_unexpected(looked.error());
    if (seen_.size() >= wanted) break;
    first += 8 * count;
    count = kRough;
  }
  return ThermalCalibrator(config_.calibrator).calibrate(seen_, mount, plate_, normal_);
}

}  // namespace

Result<ThermalCalibration> calibrateThermal(CalibrationRig& rig, const ThermalPartConfig& config) {
  return PlateWatch(rig, config).calibrate();
}

}  // namespace kiln
