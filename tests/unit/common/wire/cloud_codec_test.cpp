#include "common/wire/cloud_codec.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln::wire {
namespace {

/// A sweep in a room of 14 x 10 x 5 m, in firing order: ring after ring for each azimuth.
PointCloud makeRoom(int azimuths, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.01);
  PointCloud cloud;
  for (int a = 0; a < azimuths; ++a) {
    const double yaw = 2.0 * M_PI * a / azimuths;
    for (int r = 0; r < 16; ++r) {
      const double pitch = (2.0 * r - 15.0) * kDeg;
      const double to_wall = std::min(7.0 / std::abs(std::cos(yaw)), 5.0 / std::abs(std::sin(yaw)));
      const double to_level = pitch < 0 ? 1.0 / std::tan(-pitch) : 4.0 / std::tan(pitch);
      const double d = std::round(std::min(to_wall, to_level) * 500.0) / 500.0 + noise(random);
      const auto i = static_cast<std::uint8_t>(20 + 10 * r % 80);
      cloud.push(static_cast<float>(d * std::cos(yaw)), static_cast<float>(d * std::sin(yaw)),
                 static_cast<float>(d * std::tan(pitch)), i, static_cast<std::uint8_t>(r),
                 static_cast<float>(a * 55.296e-6 + r * 2.304e-6));
    }
  }
  return cloud;
}

TEST(CloudCodec, KeepsOrderAndCoordinatesWithinHalfAStep) {
  const PointCloud cloud = makeRoom(1808, 3);
  for (const double resolution_m : {0.005, 0.002}) {
    const auto back = unpackCloud(packCloud(cloud, resolution_m));
    ASSERT_TRUE(back.has_value()) << back.error();
    ASSERT_EQ(back->size(), cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      // Half a step, and the rounding of float at 15 m.
      ASSERT_NEAR(back->x[i], cloud.x[i], 0.5 * resolution_m + 2e-6);
      ASSERT_NEAR(back->y[i], cloud.y[i], 0.5 * resolution_m + 2e-6);
      ASSERT_NEAR(back->z[i], cloud.z[i], 0.5 * resolution_m + 2e-6);
      ASSERT_NEAR(back->time_offset_s[i], cloud.time_offset_s[i], 1.1e-6);
    }
    EXPECT_EQ(back->ring, cloud.ring);
    EXPECT_EQ(back->intensity, cloud.intensity);
  }
}

TEST(CloudCodec, PacksARoomAtLeastFiveTimesSmallerThanFloats) {
  const PointCloud cloud = makeRoom(1808, 5);
  const v1::Cloud packed = packCloud(cloud, 0.005);
  const std::size_t bytes =
      packed.xyz().size() + packed.intensity().size() + packed.ring().size() + packed.time().size();
  EXPECT_LT(bytes * 5, cloud.size() * 16);
  RecordProperty("bytes", static_cast<int>(bytes));
}

TEST(CloudCodec, AnyValuesSurviveOrBecomeNoReturn) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<float> far(-400.0f, 400.0f);
  std::uniform_int_distribution<int> byte(0, 255);
  PointCloud cloud;
  for (int i = 0; i < 5000; ++i) {
    const bool none = i % 7 == 0;
    cloud.push(none ? std::nanf("") : far(random), far(random), far(random),
               static_cast<std::uint8_t>(byte(random)), static_cast<std::uint8_t>(byte(random)),
               0.0f);
  }
  const double resolution_m = 0.005;
  const double reach_m = 32767 * resolution_m + 0.5 * resolution_m;
  const auto back = unpackCloud(packCloud(cloud, resolution_m));
  ASSERT_TRUE(back.has_value()) << back.error();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool fits = std::abs(cloud.x[i]) < reach_m && std::abs(cloud.y[i]) < reach_m &&
                      std::abs(cloud.z[i]) < reach_m;
    ASSERT_EQ(std::isnan(back->x[i]), !fits) << i << ": " << cloud.x[i];
    ASSERT_EQ(std::isnan(back->z[i]), !fits) << i;
    if (fits) {
      ASSERT_NEAR(back->y[i], cloud.y[i], 0.5 * resolution_m + 2e-5);
    }
  }
}

TEST(CloudCodec, TimesOutsideTheScaleAreClamped) {
  PointCloud cloud;
  for (const float t : {-1.0f, 0.1f, 5.0f, std::nanf("")}) cloud.push(1, 2, 3, 0, 0, t);
  const auto back = unpackCloud(packCloud(cloud, 0.005));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_FLOAT_EQ(back->time_offset_s[0], 0.0f);
  EXPECT_NEAR(back->time_offset_s[1], 0.1f, 1.1e-6);
  EXPECT_NEAR(back->time_offset_s[2], 65535 * kCloudTimeUnit_s, 1e-6);
  EXPECT_FLOAT_EQ(back->time_offset_s[3], 0.0f);
}

TEST(CloudCodec, EmptyCloudTravels) {
  const auto back = unpackCloud(packCloud(PointCloud{}, 0.002));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->size(), 0u);
}

}  // namespace
}  // namespace kiln::wire
