#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "common/core/units.h"
#include "common/geom/frames.h"
#include "robot/hal/arena.h"
#include "robot/perception/cloud/face_model.h"
#include "robot/perception/cloud/scan_window.h"
#include "robot/scene/fire_site_map.h"
#include "tests/support/thermal_renderer.h"

namespace kiln {

/// What the LiDAR sees of the fire places: points all over the opaque faces that are turned to it.
/// The place `moved` stands `by` from where it is configured.
class PlaceScans {
 public:
  PlaceScans(FireSiteMap site, std::string moved, const Pose2& by)
      : site_(std::move(site)), moved_(std::move(moved)), by_(by) {}
  [[nodiscard]] std::deque<ScanWindow::Entry> look(Stamp now, const Eigen::Isometry3d& X_map_base,
                                                   const Eigen::Isometry3d& X_base_lidar) const {
    auto scan = std::make_shared<PointCloud>();
    scan->stamp = now;
    scan->frame = frames::kBase;
    for (const FirePlaceConfig& place : site_.places)
      add(*scan, X_map_base.inverse() * front(place), X_base_lidar.translation());
    return {{scan, X_map_base, X_base_lidar}};
  }

 private:
  [[nodiscard]] Eigen::Isometry3d front(const FirePlaceConfig& place) const {
    const auto& p = place.plate_xyz_m;
    Eigen::Isometry3d X = site_.front({p[0], p[1], p[2]}, place.facing_deg * kDeg);
    if (place.name != moved_) return X;
    X.linear() = Eigen::AngleAxisd(by_.yaw_rad, Eigen::Vector3d::UnitZ()) * X.linear();
    X.translation() += Eigen::Vector3d(by_.x_m, by_.y_m, 0.0);
    return X;
  }
  static void add(PointCloud& scan, const Eigen::Isometry3d& X_base_front,
                  const Eigen::Vector3d& p_base_lidar) {
    constexpr double kStep_m = 0.02;
    for (const Face& face : fireBoxFaces({})) {
      if ((X_base_front.inverse() * p_base_lidar - face.centre).dot(face.n) <= 0.0) continue;
      for (double a = -face.half_u; a <= face.half_u; a += kStep_m)
        for (double b = -face.half_v; b <= face.half_v; b += kStep_m) {
          const Eigen::Vector3f p =
              (X_base_front * (face.centre + a * face.u + b * face.v)).cast<float>();
          scan.push(p.x(), p.y(), p.z(), 40.0F, 0, 0.0F);
        }
    }
  }
  FireSiteMap site_;
  std::string moved_;
  const Pose2& by_;
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
