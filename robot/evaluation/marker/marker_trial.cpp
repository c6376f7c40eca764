#include "robot/evaluation/marker/marker_trial.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "robot/missions/wall/looking_posture.h"

namespace kiln {
namespace {

constexpr double kWindow_s = 10.0, kSweeps = 1.5;
constexpr double kExtrinsic_m = 0.005, kExtrinsic_rad = 0.3 * kDeg;

Eigen::Isometry3d perturbed(const Eigen::Isometry3d& X, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto three = [&](double sigma) {
    const double a = normal(random), b = normal(random), c = normal(random);
    return Eigen::Vector3d(sigma * a, sigma * b, sigma * c);
  };
  return X * makePose(three(kExtrinsic_m), three(kExtrinsic_rad));
}

}  // namespace

MarkerTrial::MarkerTrial(const MarkerYard& yard, const RobotGeometry& robot, std::uint64_t seed)
    : yard_(yard), nominal_(robot), painter_(yard.scene, robot, yard.camera, seed) {
  std::mt19937_64 random(seed ^ 0x9e3779b97f4a7c15ULL);
  X_flange_rgb_ = perturbed(robot.X_flange_rgb.pose(), random);
  X_flange_lidar_ = perturbed(robot.X_flange_lidar.pose(), random);
  std::normal_distribution<double> normal(0.0, 1.0);
  pan_phase_ = std::uniform_real_distribution<double>(0.0, 1.0)(random);
  odometry_scale_ = 1.0 + 0.005 * normal(random);
  odometry_turn_rad_ = 0.3 * kDeg * normal(random);
  odometry_yaw_per_m_ = 0.3 * kDeg * normal(random);
}

Pose2 MarkerTrial::basePose(double share) const {
  const Pose2 &a = yard_.X_map_start, &b = yard_.X_map_end;
  return {a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
          a.yaw_rad + share * wrapAngle(b.yaw_rad - a.yaw_rad)};
}

Vector6d MarkerTrial::posture(double share) const {
  // Near the marker the head looks farther down on every other sweep.
  const double distance = std::hypot(yard_.X_map_end.x_m, yard_.X_map_end.y_m);
  const double turn = kSweeps * share + pan_phase_;
  const double pan = 25.0 * kDeg * std::sin(2.0 * M_PI * turn);
  const double swing = 0.5 - 0.5 * std::cos(M_PI * 2.0 * turn * 0.5);
  const double low = distance < 6.0 ? 42.0 : distance < 9.0 ? 20.0 : 12.0;
  const double high = distance < 6.0 ? 18.0 : distance < 9.0 ? 16.0 : 10.0;
  return lookingPosture(pan, (high + swing * (low - high)) * kDeg);
}

MarkerTrial::Step MarkerTrial::at(double share) {
  Step out;
  const Pose2 X_map_base2 = basePose(share);
  const Eigen::Isometry3d X_map_base = yard_.scene.ground.standing(X_map_base2, nominal_);
  const Vector6d q = posture(share);
  const Eigen::Isometry3d X_base_flange = nominal_.X_base_flange(q);
  const double pan_rate = 25.0 * kDeg * 2.0 * M_PI * kSweeps / kWindow_s *
                          std::cos(2.0 * M_PI * (kSweeps * share + pan_phase_));
  out.image = painter_.paint(X_map_base, q, X_map_base * X_base_flange * X_flange_rgb_, pan_rate);
  out.image.stamp = stampFromNanoseconds(1'000'000'000) + fromSeconds(kWindow_s * 0.99 * share);
  PointCloud scan = painter_.scan(X_map_base * X_base_flange * X_flange_lidar_);
  const Eigen::Isometry3f X_base_lidar =
      (X_base_flange * nominal_.X_flange_lidar.pose()).cast<float>();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f p = X_base_lidar * Eigen::Vector3f(scan.x[i], scan.y[i], scan.z[i]);
    scan.x[i] = p.x();
    scan.y[i] = p.y();
    scan.z[i] = p.z();
  }
  scan.frame = "base";
  out.scan_base = std::move(scan);
  out.from.X_base_rgb = X_base_flange * nominal_.X_flange_rgb.pose();
  // Odometry: begins where the drive does.
  const Pose2 moved = inverse(basePose(0.0)) * X_map_base2;
  const double way = std::hypot(moved.x_m, moved.y_m);
  const Pose2 turned = Pose2{0.0, 0.0, odometry_turn_rad_} *
                       Pose2{odometry_scale_ * moved.x_m, odometry_scale_ * moved.y_m, 0.0};
  out.from.X_odom_base = {turned.x_m, turned.y_m, moved.yaw_rad + odometry_yaw_per_m_ * way};
  out.X_map_base = X_map_base2;
  out.X_base_wall = X_map_base.inverse() * toIsometry(yard_.scene.X_map_wall);
  return out;
}

}  // namespace kiln
