#include "robot/perception/cloud/local_ground.h"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kLidarHeight = 1.5;

/// Rings of a VLP-16 at (0, 0, kLidarHeight) over a ground of the given height, with noise.
PointCloud scanOf(const std::function<double(double x, double y)>& ground) {
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0.0f, 0.012f);
  PointCloud scan;
  for (int ring = 0; ring < 16; ++ring) {
    const double slope = std::tan((-15.0 + 2.0 * ring) * kDeg);
    for (int i = 0; i < 720; ++i) {
      const double a = 0.5 * i * kDeg;
      for (double r = 1.0; r < 15.0; r += 0.01) {  // march along the beam
        const double x = r * std::cos(a), y = r * std::sin(a);
        if (kLidarHeight + slope * r > ground(x, y)) continue;
        scan.push(static_cast<float>(x), static_cast<float>(y),
                  static_cast<float>(kLidarHeight + slope * r) + noise(random), 30,
                  static_cast<std::uint8_t>(ring), 0.0f);
        break;
      }
    }
  }
  return scan;
}

double worstGround(const std::function<double(double, double)>& ground, double to_m) {
  const LocalGround profile({}, scanOf(ground));
  double worst = 0.0;
  for (double x = -to_m; x <= to_m; x += 0.25)
    for (double y = -to_m; y <= to_m; y += 0.25)
      if (std::hypot(x, y) < to_m)
        worst = std::max(worst, std::abs(profile.groundAt(x, y) - ground(x, y)));
  return worst;
}

TEST(LocalGround, FollowsFlatGroundSlopesAndEdges) {
  EXPECT_LT(worstGround([](double, double) { return 0.0; }, 9.0), 0.06);
  // The robot stands on the slope itself, pitched with it: the ground is its own plane. Before a
  // slope of 4 deg that begins 3 m ahead it is not.
  const auto slope_ahead = [](double x, double) {
    return x > 3.0 ? (x - 3.0) * std::tan(4 * kDeg) : 0.0;
  };
  EXPECT_LT(worstGround(slope_ahead, 8.0), 0.12);
  const auto edge = [](double x, double) { return x > 2.5 ? 0.02 : 0.0; };
  EXPECT_LT(worstGround(edge, 8.0), 0.08);
  const auto falls_away = [](double x, double) {
    return x > 2.0 ? -(x - 2.0) * std::tan(4 * kDeg) : 0.0;
  };
  EXPECT_LT(worstGround(falls_away, 6.0), 0.12);
}

TEST(LocalGround, ABoxOnASlopeKeepsItsHeight) {
  // 0.5 m high, 4 m ahead on a slope of 4 deg that begins under the robot's front.
  const auto slope = [](double x, double) {
    return x > 1.0 ? (x - 1.0) * std::tan(4 * kDeg) : 0.0;
  };
  const auto with_box = [&](double x, double y) {
    return slope(x, y) + (x > 4.0 && x < 4.4 && std::abs(y) < 0.4 ? 0.5 : 0.0);
  };
  const PointCloud scan = scanOf(with_box);
  const LocalGround profile({}, scan);
  int on_box = 0, known_high = 0, false_high = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double x = scan.x[i], y = scan.y[i], r = std::hypot(x, y);
    const double height = profile.heightOf(scan.x[i], scan.y[i], scan.z[i]);
    const bool box = x > 3.9 && x < 4.5 && std::abs(y) < 0.42 && scan.z[i] > slope(x, y) + 0.2;
    on_box += box ? 1 : 0;
    known_high += box && height > 0.12 ? 1 : 0;
    const bool beside = std::abs(y) > 0.7 || x < 3.0;
    false_high += beside && r < 8.0 && height > 0.12 ? 1 : 0;
  }
  EXPECT_GT(on_box, 20);
  EXPECT_EQ(known_high, on_box);
  EXPECT_EQ(false_high, 0);
}

TEST(LocalGround, NothingSeenIsThePlaneOfTheWheels) {
  PointCloud scan;
  scan.push(NAN, 1, 1, 0, 0, 0);
  const LocalGround profile({}, scan);
  EXPECT_EQ(profile.groundAt(3, 4), 0.0);
}

}  // namespace
}  // namespace kiln
