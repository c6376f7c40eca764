#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "common/core/units.h"
#include "robot/hal/arena.h"
#include "robot/scene/arena_map.h"
#include "robot/skills/surroundings.h"
#include "tests/support/thermal_renderer.h"

namespace kiln {

/// Says of every place that it stands where it is configured, of one that it stands `by` from
/// there; nothing else stands around.
class FakeSurroundings final : public Surroundings {
 public:
  FakeSurroundings(const Clock& clock, std::string moved, const Pose2& by)
      : clock_(clock), moved_(std::move(moved)), by_(by) {}
  [[nodiscard]] ObstacleCloudPtr obstacles() const override { return nullptr; }
  [[nodiscard]] Pose2 X_odom_base() const override { return {}; }
  void beginPlaceCheck(const std::string& place, const Eigen::Isometry3d& X_map_front) override {
    const Pose2 at = projectToGround(first_.try_emplace(place, X_map_front).first->second);
    const Pose2 by = place == moved_ ? by_ : Pose2{};
    PlaceCheck check;
    check.stamp = clock_.now();
    check.place = place;
    check.X_map_configured = X_map_front;
    check.X_map_sensed =
        toIsometry(Pose2{at.x_m + by.x_m, at.y_m + by.y_m, at.yaw_rad + by.yaw_rad});
    check.X_map_sensed->translation().z() = X_map_front.translation().z();
    const Pose2 off = check.correction();
    check.offset_m = std::hypot(off.x_m, off.y_m);
    check.yaw_offset_rad = off.yaw_rad;
    check.coverage = 0.74;
    check.points = 412;
    check.verdict = check.offset_m < kTolerance_m ? PlaceVerdict::Fits : PlaceVerdict::Misplaced;
    check.reason = check.verdict == PlaceVerdict::Fits ? "fits" : place + " stands elsewhere";
    answer_ = check;
  }
  [[nodiscard]] std::optional<PlaceCheck> placeCheck() const override { return answer_; }

 private:
  static constexpr double kTolerance_m = 0.145;
  const Clock& clock_;
  std::string moved_;
  const Pose2& by_;
  std::map<std::string, Eigen::Isometry3d> first_;  ///< as configured
  std::optional<PlaceCheck> answer_;
};

/// Carries the robot back at once.
class FakeReferee final : public Arena {
 public:
  explicit FakeReferee(std::function<void()> carry) : carry_(std::move(carry)) {}
  Result<void> requestReset() override {
    carry_();
    return {};
  }
  Result<void> startClock() override { return {}; }

 private:
  std::function<void()> carry_;
};

/// A plate in its box that is lit when the mission starts, and what the thermal camera sees of it.
class HotPlate {
 public:
  explicit HotPlate(const FirePlaceConfig& place) {
    const double facing_rad = place.facing_deg * kDeg;
    const Eigen::Vector3d out(std::cos(facing_rad), std::sin(facing_rad), 0.0);
    scene_.X_map_plate.linear().col(0) = Eigen::Vector3d::UnitZ().cross(out);
    scene_.X_map_plate.linear().col(1) = Eigen::Vector3d::UnitZ();
    scene_.X_map_plate.linear().col(2) = out;
    scene_.X_map_plate.translation() = Eigen::Vector3d::Map(place.plate_xyz_m.data());
  }
  [[nodiscard]] ThermalImage look(const Eigen::Isometry3d& X_map_thermal, double lit_s,
                                  const Pose2& misplaced) {
    testing::ThermalScene scene = scene_;
    scene.X_map_plate.translation() += Eigen::Vector3d(misplaced.x_m, misplaced.y_m, 0.0);
    scene.plate_k = kAmbient_k + kHeatRise_k * (1.0 - std::exp(-lit_s / kHeatTime_s));
    return renderer_.render(scene, X_map_thermal);
  }

 private:
  static constexpr double kAmbient_k = 298.15, kHeatRise_k = 105.0;
  static constexpr double kHeatTime_s = 60.0;  ///< scenario.md section 3
  testing::ThermalRenderer renderer_{{}, 1};
  testing::ThermalScene scene_;
};

}  // namespace kiln
