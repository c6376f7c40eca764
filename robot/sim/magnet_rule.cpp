#include "robot/sim/magnet_rule.h"

#include <algorithm>
#include <cmath>

namespace kiln::sim {
namespace {

constexpr double kTouching_m = 5e-5;

double axisShare(double p, double lo, double hi, double r) {
  const double reach = std::min(p + r, hi) - std::max(p - r, lo);
  return std::clamp(reach / (2.0 * r), 0.0, 1.0);
}

}  // namespace

double plateShare(const TrueBrick& brick, const Eigen::Vector2d& p, double r) {
  double share = 0.0;
  for (const Eigen::AlignedBox2d& plate : brick.plates)
    share += axisShare(p.x(), plate.min().x(), plate.max().x(), r) *
             axisShare(p.y(), plate.min().y(), plate.max().y(), r);
  return std::min(1.0, share);
}

double magnetPull(const MagnetConfig& config, double field, double share, double gap_m) {
  // (1 + gap / scale)^-2 is a half at half_gap_m.
  const double scale = config.half_gap_m / (M_SQRT2 - 1.0);
  const double near = 1.0 + std::max(0.0, gap_m) / scale;
  return config.flush_n / static_cast<double>(kMagnets) * field * field * share / (near * near);
}

double MagnetTouch::pull() const {
  double sum = 0.0;
  for (const double n : pull_n) sum += n;
  return sum;
}

GripVerdict judgeGrip(const MagnetConfig& config, const MagnetTouch& touch, const GripLoad& load) {
  const auto positions = magnetPositions();
  Eigen::AlignedBox2d face;
  double pull = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  // of the pulls: sum of p F
  for (std::size_t i = 0; i < kMagnets; ++i) {
    pull += touch.pull_n[i];
    moment += touch.pull_n[i] * positions[i];
    if (touch.gap_m[i] > kTouching_m) continue;
    const Eigen::Vector2d r = Eigen::Vector2d::Constant(config.radius_m);
    face.extend(Eigen::AlignedBox2d(positions[i] - r, positions[i] + r));
  }
  const double pressed = pull - load.force_n.z();
  if (face.isEmpty() || pull <= 0.0 || pressed <= 0.0) return GripVerdict::ComesOff;
  const Eigen::Vector2d centre((moment.x() + load.torque_nm.y()) / pressed,
                               (moment.y() - load.torque_nm.x()) / pressed);
  if (!face.contains(centre)) return GripVerdict::ComesOff;
  const double shear_n = config.shear_n / config.flush_n * pressed;
  // Mean distance from the middle of a rectangle, near enough: half its half-diagonal's 1.06.
  const double arm = 0.53 * 0.5 * face.diagonal().norm();
  const double used =
      std::hypot(load.force_n.head<2>().norm() / shear_n, load.torque_nm.z() / (shear_n * arm));
  return used > 1.0 ? GripVerdict::Slips : GripVerdict::Holds;
}

}  // namespace kiln::sim
