#include "robot/missions/wall/skills/sweep_coverage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr int kLasers = 16;  // VLP-16: from -15 to 15 deg
constexpr double kLowest_deg = -15.0, kSpacing_deg = 2.0;

double tiltOf(const Eigen::Isometry3d& X) {
  return -std::asin(std::clamp(X.linear()(2, 0), -1.0, 1.0)) / kDeg;
}

}  // namespace

SweepCoverage coverageOf(std::span<const Eigen::Isometry3d> X_base_lidar) {
  SweepCoverage out;
  if (X_base_lidar.size() < 2) return out;
  out.tilt_from_deg = tiltOf(X_base_lidar.front());
  out.tilt_to_deg = tiltOf(X_base_lidar.back());
  std::vector<double> lines;
  double before = out.tilt_from_deg;
  for (const Eigen::Isometry3d& X : X_base_lidar) {
    const double tilt = tiltOf(X);
    out.step_deg = std::max(out.step_deg, std::abs(tilt - before));
    before = tilt;
    for (int laser = 0; laser < kLasers; ++laser)
      lines.push_back(kLowest_deg + kSpacing_deg * laser - tilt);
  }
  std::sort(lines.begin(), lines.end());
  // At either end only the outermost laser passes; the first spacing there is as wide as its own.
  const double low = lines.front() + kSpacing_deg, high = lines.back() - kSpacing_deg;
  int gaps = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i - 1] < low || lines[i] > high) continue;
    const double gap = lines[i] - lines[i - 1];
    out.widest_gap_deg = std::max(out.widest_gap_deg, gap);
    out.line_gap_deg += (gap - out.line_gap_deg) / ++gaps;
  }
  return out;
}

}  // namespace kiln
