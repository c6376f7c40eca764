#include "robot/planning/arm_motion/ur_inverse.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

constexpr double kTurn = 2.0 * M_PI;
constexpr double kWristSingular = 1e-8;  // sine of joint 5
constexpr double kReachSlack = 1e-9;     // rounding at the fully stretched arm

double wrapped(double angle) { return std::remainder(angle, kTurn); }

/// Joint 1 from the wrist centre's distance to the shoulder plane: z1 . p5 = d4.
std::vector<double> shoulderAngles(const UrKinematics& arm, const Eigen::Vector3d& p5) {
  const double rho = std::hypot(p5.x(), p5.y());
  if (rho < std::abs(arm.d[3])) return {};
  const double bearing = std::atan2(p5.y(), p5.x());
  const double offset = std::asin(arm.d[3] / rho);
  return {bearing + offset, bearing + M_PI - offset};
}

Eigen::Isometry3d link(const UrKinematics& arm, std::size_t i, double q) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(q, Eigen::Vector3d::UnitZ()) *
                           Eigen::Translation3d(arm.a[i], 0.0, arm.d[i]) *
                           Eigen::AngleAxisd(arm.alpha[i], Eigen::Vector3d::UnitX()));
}

/// Joints 2 to 4, a planar three-link chain in frame 1, for given joints 1, 5 and 6.
void solvePlanar(const UrKinematics& arm, const Eigen::Isometry3d& X_1_4, Vector6d q,
                 std::vector<Vector6d>& out) {
  const double x = X_1_4.translation().x();
  const double y = X_1_4.translation().y();
  const double a2 = arm.a[1], a3 = arm.a[2];
  double c3 = (x * x + y * y - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
  if (std::abs(c3) > 1.0 + kReachSlack) return;
  c3 = std::clamp(c3, -1.0, 1.0);
  const double q234 = std::atan2(X_1_4.linear()(1, 0), X_1_4.linear()(0, 0));
  const double s3_abs = std::sqrt(1.0 - c3 * c3);
  for (const double s3 : {s3_abs, -s3_abs}) {
    q[2] = std::atan2(s3, c3);
    q[1] = wrapped(std::atan2(y, x) - std::atan2(a3 * s3, a2 + a3 * c3));
    q[3] = wrapped(q234 - q[1] - q[2]);
    out.push_back(q);
    if (s3_abs == 0.0) return;
  }
}

}  // namespace

std::vector<Vector6d> inverseSolutions(const UrKinematics& arm,
                                       const Eigen::Isometry3d& X_armbase_flange,
                                       const Vector6d& reference) {
  std::vector<Vector6d> out;
  const Eigen::Matrix3d R = X_armbase_flange.linear();
  const Eigen::Vector3d p5 = X_armbase_flange.translation() - arm.d[5] * R.col(2);
  for (const double q1 : shoulderAngles(arm, p5)) {
    // The common axis of joints 2, 3 and 4 seen from the flange is (s5 c6, -s5 s6, c5).
    const Eigen::Vector3d z1(std::sin(q1), -std::cos(q1), 0.0);
    const Eigen::Vector3d n = R.transpose() * z1;
    const double s5_abs = std::hypot(n.x(), n.y());
    const Eigen::Isometry3d X_1_flange = link(arm, 0, q1).inverse() * X_armbase_flange;
    for (const double sign : {1.0, -1.0}) {
      Vector6d q = Vector6d::Zero();
      q[0] = wrapped(q1);
      q[4] = std::atan2(sign * s5_abs, n.z());
      q[5] =
          s5_abs > kWristSingular ? std::atan2(-sign * n.y(), sign * n.x()) : wrapped(reference[5]);
      const Eigen::Isometry3d X_4_flange = link(arm, 4, q[4]) * link(arm, 5, q[5]);
      solvePlanar(arm, X_1_flange * X_4_flange.inverse(), q, out);
      if (s5_abs <= kWristSingular) break;
    }
  }
  return out;
}

Vector6d nearestTurn(const UrKinematics& arm, const Vector6d& q, const Vector6d& reference) {
  Vector6d out = q;
  for (int i = 0; i < 6; ++i) {
    const double nearest = reference[i] + wrapped(q[i] - reference[i]);
    for (const double candidate : {nearest, nearest - kTurn, nearest + kTurn, q[i]}) {
      if (std::abs(candidate) <= arm.position_limit[i]) {
        out[i] = candidate;
        break;
      }
    }
  }
  return out;
}

std::vector<Vector6d> turnVariants(const UrKinematics& arm, const Vector6d& q) {
  std::vector<Vector6d> out{q};
  for (int i = 0; i < 6; ++i) {
    const std::size_t n = out.size();
    for (const double turn : {-kTurn, kTurn}) {
      if (std::abs(q[i] + turn) > arm.position_limit[i]) continue;
      for (std::size_t k = 0; k < n; ++k) {
        out.push_back(out[k]);
        out.back()[i] += turn;
      }
    }
  }
  return out;
}

bool withinLimits(const UrKinematics& arm, const Vector6d& q, double margin_rad) {
  return q.allFinite() && (q.cwiseAbs().array() <= arm.position_limit.array() - margin_rad).all();
}

}  // namespace kiln
