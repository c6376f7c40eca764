#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "robot/sim/lidar_sensor.h"
#include "robot/sim/thermal_sensor.h"
#include "tests/unit/robot/sim/test_scene.h"

namespace kiln::sim {
namespace {

double hottest(const ThermalImage& image) {
  return *std::max_element(image.counts.begin(), image.counts.end()) * 0.01 - 273.15;
}

int warmerThan(const ThermalImage& image, double celsius) {
  return static_cast<int>(
      std::count_if(image.counts.begin(), image.counts.end(),
                    [&](std::uint16_t c) { return c * 0.01 - 273.15 > celsius; }));
}

struct ThermalTest : ::testing::Test {
  ThermalImagePtr look(double range_m, double bearing_rad, double plate_c) {
    world.state.plate_c = plate_c;
    world.putFlangePart(world.arena.robot.X_flange_thermal,
                        world.lookAtPlate(range_m, bearing_rad));
    return sensor.capture(world.state, *world.scene, false);
  }
  TestScene world;
  WetBoards dry{{}, world.arena};
  ThermalSensor sensor{world.config.thermal, world.robot, world.arena.robot, dry, 1};
};

TEST_F(ThermalTest, PlateIsSeenThroughTheOpeningAtItsTrueSize) {
  const auto image = look(1.0, 0.0, 125.0);
  EXPECT_NEAR(hottest(*image), 125.0, 2.0);
  // Focal length 80 / tan(28.5 deg) = 147.3 px; a disc of 0.15 m at 1.0 m has a radius of 11.05 px:
  // 384 px.
  EXPECT_NEAR(warmerThan(*image, 75.0), 384, 15);
}

TEST_F(ThermalTest, OpeningCutsThePlateOffWhenSeenAslant) {
  // 30 deg off axis the rim of the opening, 10 cm before the plate, hides 5.8 of the 15 cm.
  const int straight = warmerThan(*look(1.0, 0.0, 125.0), 75.0);
  const int aslant = warmerThan(*look(1.0, M_PI / 6, 125.0), 75.0);
  EXPECT_GT(aslant, straight / 4);
  EXPECT_LT(aslant, 3 * straight / 4);
}

// 30 deg off axis at 1 m the opening's shadow on the plate is a disc of 8.5 cm radius, 6.5 cm
// aside: it leaves a lens of 56 % of the plate (a square opening would leave 66 %), foreshortened
// by 0.87.
TEST_F(ThermalTest, TheOpeningIsRound) {
  const int straight = warmerThan(*look(1.0, 0.0, 125.0), 75.0);
  const int aslant = warmerThan(*look(1.0, M_PI / 6, 125.0), 75.0);
  EXPECT_NEAR(aslant / static_cast<double>(straight), 0.87 * 0.56, 0.04);
}

TEST_F(ThermalTest, AcrylicHidesThePlateFromTheSideAndFromBehind) {
  for (const double bearing : {0.5 * M_PI, M_PI})
    EXPECT_LT(hottest(*look(1.0, bearing, 125.0)), 45.0) << bearing;
}

TEST_F(ThermalTest, MirrorImageIsWarmButNeverAsHotAsThePlate) {
  const auto image = look(1.0, 0.0, 130.0);
  const double ghost = world.config.fire.ambient_c + world.fire().reflection_ratio * 105.0;
  EXPECT_GE(ghost, 45.0 - 1e-9);
  EXPECT_LE(ghost, 70.0 + 1e-9);
  // The ghost has a diameter of 7 cm: at 0.9 m some 100 px between it and the plate's temperature
  // band.
  const int ghost_px = warmerThan(*image, ghost - 4.0) - warmerThan(*image, ghost + 4.0);
  EXPECT_GT(ghost_px, 60);
}

TEST_F(ThermalTest, NoiseIs50mKOverAFixedPatternOf300mK) {
  const auto first = look(1.5, M_PI, 25.0);
  constexpr int kFrames = 40;
  std::vector<double> mean(first->counts.size()), square(first->counts.size());
  for (int i = 0; i < kFrames; ++i) {
    const auto image = sensor.capture(world.state, *world.scene, false);
    for (std::size_t k = 0; k < mean.size(); ++k) {
      mean[k] += image->counts[k] / static_cast<double>(kFrames);
      square[k] += image->counts[k] * static_cast<double>(image->counts[k]) / kFrames;
    }
  }
  double variance = 0;
  for (std::size_t k = 0; k < mean.size(); ++k)
    variance += (square[k] - mean[k] * mean[k]) / static_cast<double>(mean.size());
  EXPECT_NEAR(std::sqrt(variance) * 0.01, 0.050, 0.005);  // counts are rounded to 10 mK
  double pattern =
      0;  // neighbours see the same wall: their difference is the pattern, sqrt(2) times
  for (std::size_t k = 1; k < mean.size(); ++k) {
    const double difference = std::min(100.0, std::fabs(mean[k] - mean[k - 1]));
    pattern += difference * difference / static_cast<double>(mean.size());
  }
  EXPECT_NEAR(std::sqrt(0.5 * pattern) * 0.01, 0.30, 0.05);
}

TEST_F(ThermalTest, ShutterFreezesPictureAndCounter) {
  world.putFlangePart(world.arena.robot.X_flange_thermal, world.lookAtPlate(1.0, 0.0));
  int frozen = 0, shutters = 0;
  ThermalImagePtr last;
  for (Stamp t = sensor.nextFrame(Stamp{}); toSeconds(t) < 400.0; t = sensor.nextFrame(t)) {
    if (!sensor.shutterClosed(t) && (!last || last->ffc != FfcState::Running))
      continue;  // only around the shutter
    world.state.stamp = t;
    const auto image = sensor.capture(world.state, *world.scene, false);
    if (image->ffc == FfcState::Running && last && last->ffc == FfcState::Running) {
      EXPECT_EQ(image->frame_counter, last->frame_counter);
      EXPECT_EQ(image->counts, last->counts);
      ++frozen;
    }
    if (image->ffc == FfcState::Running && (!last || last->ffc != FfcState::Running)) ++shutters;
    last = image;
  }
  EXPECT_GE(shutters, 2);
  EXPECT_LE(shutters, 3);
  EXPECT_NEAR(frozen, 4 * shutters,
              shutters);  // 0.6 s at 8.77 Hz: 5 or 6 frames, the first not counted here
}

struct LidarTest : ::testing::Test {
  PointCloudPtr scan(LidarSensor& sensor) {
    world.scene->update(world.state);
    PointCloudPtr done;
    while (!done) {
      SceneState after = world.state;
      after.stamp += fromSeconds(0.02);
      done = sensor.advance(world.state, after, *world.scene);
      world.state.stamp = after.stamp;
    }
    return done;
  }
  /// Range error of each point against the same scene, by ring; edges left out.
  std::map<int, std::vector<double>> errors(const PointCloud& cloud) const {
    const Eigen::Isometry3d X = world.state.X_map_base * world.robot.X_base_flange(world.state.q) *
                                world.arena.robot.X_flange_lidar;
    std::vector<Raycaster::Ray> rays;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d d =
          X.linear() * Eigen::Vector3d(cloud.x[i], cloud.y[i], cloud.z[i]).normalized();
      rays.push_back({X.translation().cast<float>(), d.cast<float>(), 200.0F, mask::kLidar});
    }
    std::vector<Raycaster::Hit> hits(rays.size());
    world.scene->rays().cast(rays, hits);
    std::map<int, std::vector<double>> out;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double error =
          Eigen::Vector3d(cloud.x[i], cloud.y[i], cloud.z[i]).norm() - hits[i].range;
      if (hits[i].valid() && std::fabs(error) < 0.08) out[cloud.ring[i]].push_back(error);
    }
    return out;
  }
  TestScene world;
};

double mean(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

TEST_F(LidarTest, EachLaserHasItsBiasAndTenMillimetresOfNoise) {
  world.state.X_map_base = toIsometry({9.0, 0.0, 0.3});
  LidarSensor sensor(world.config.lidar, world.robot, world.arena.robot, 4);
  const auto first = errors(*scan(sensor)), second = errors(*scan(sensor));
  ASSERT_EQ(first.size(), 16u);
  double bias_square = 0;
  for (const auto& [ring, e] : first) {
    ASSERT_GT(e.size(), 300u) << ring;
    const double bias = mean(e);
    EXPECT_NEAR(bias, mean(second.at(ring)), 0.002) << ring;  // fixed: 10 mm / sqrt(400) twice
    double variance = 0;
    for (const double x : e) variance += (x - bias) * (x - bias) / static_cast<double>(e.size());
    EXPECT_NEAR(std::sqrt(variance), 0.010, 0.002) << ring;
    bias_square += bias * bias / 16;
  }
  EXPECT_GT(std::sqrt(bias_square), 0.004);
  EXPECT_LT(std::sqrt(bias_square), 0.018);
}

TEST_F(LidarTest, PointsCarryRisingTimesWithinOneTurn) {
  world.state.X_map_base = toIsometry({9.0, 0.0, 0.0});
  LidarSensor sensor(world.config.lidar, world.robot, world.arena.robot, 1);
  const auto cloud = scan(sensor);
  EXPECT_EQ(cloud->frame, "lidar");
  EXPECT_NEAR(cloud->time_offset_s.back(), 0.1, 0.01);  // the arm hides the rear
  for (std::size_t i = 1; i < cloud->size(); ++i)
    ASSERT_GT(cloud->time_offset_s[i], cloud->time_offset_s[i - 1] - 1e-7F);
  // Clockwise from the rear: after a quarter turn the beam points to the left (+Y).
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if (std::fabs(cloud->time_offset_s[i] - 0.025F) > 5e-4F) continue;
    EXPECT_GT(cloud->y[i], 0.0F);
  }
}

/// A box of 20 cm, 55 cm before a wall and 2 m before the LiDAR, which rises by the 7 cm between
/// two of its lasers: each of them crosses the upper edge once, with a footprint of 4 mm.
TEST_F(LidarTest, AHorizontalEdgeBetweenTwoLasersMakesMixedPixelsToo) {
  world.config.lidar.dropout = world.config.lidar.noise_sigma_m = 0.0;
  world.config.lidar.bias_sigma_m = 0.0;
  world.state.obstacle = Eigen::Vector3d(13.45, 1.5, 1.0);
  int between = 0;
  for (int step = 0; step < 60; ++step) {
    world.putFlangePart(world.arena.robot.X_flange_lidar,
                        makePose({11.35, 1.5, 1.0 + 0.0012 * step}, {0, 0, 0}));
    LidarSensor sensor(world.config.lidar, world.robot, world.arena.robot, 1);
    const auto cloud = scan(sensor);
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      const bool at_box = cloud->x[i] > 2.05F && cloud->x[i] < 2.5F;  // not on it, not on the wall
      between += at_box && std::fabs(cloud->y[i]) < 0.07F ? 1 : 0;    // its sides are at 0.1 m
    }
  }
  EXPECT_GT(between, 50);
}

TEST_F(LidarTest, AcrylicReturnsAFewRaysOnly) {
  world.config.lidar.dropout = 0.0;
  // One metre from the back of the fire box, between its frame bars there is nothing but acrylic.
  world.putFlangePart(world.arena.robot.X_flange_lidar,
                      world.fire().X_map_front * makePose({-1.4, 0, 0.04}, {0, 0, 0}));
  LidarSensor sensor(world.config.lidar, world.robot, world.arena.robot, 1);
  int pane = 0, rays = 0;
  for (int k = 0; k < 20; ++k) {
    const auto cloud = scan(sensor);
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      // Bearings that meet the back panel beside the plate (plate and flame lie within 8 cm of the
      // middle).
      const double y = cloud->y[i] / cloud->x[i], z = cloud->z[i] / cloud->x[i];
      if (cloud->x[i] < 0 || std::fabs(y) < 0.11 || std::fabs(y) > 0.145 || std::fabs(z) > 0.1)
        continue;
      ++rays;
      pane += std::fabs(cloud->x[i] - 1.0) < 0.05 ? 1 : 0;
    }
  }
  ASSERT_GT(rays, 300);
  EXPECT_GT(pane, 0);
  EXPECT_LT(pane, rays / 8);
}

}  // namespace
}  // namespace kiln::sim
