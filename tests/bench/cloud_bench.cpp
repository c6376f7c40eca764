// Cost of the point cloud path on one core for one VLP-16 revolution (28,800 points), and of the
// packet decoder.
#include <random>

#include <benchmark/benchmark.h>

#include "common/config/resources.h"
#include "robot/drivers/velodyne/codec/scan_assembler.h"
#include "robot/perception/cloud/self_filter.h"
#include "robot/perception/cloud/undistort.h"
#include "robot/perception/cloud/voxel_grid.h"

namespace kiln {
namespace {

RobotGeometry bob() {
  RobotGeometry geometry;
  if (const auto path = resourcePath("robot_model/bob.yaml")) (void)loadConfig(*path, geometry);
  return geometry;
}

/// A room of 5 x 4 m around the LiDAR, 16 x 1800.
PointCloud room() {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0f, 0.01f);
  PointCloud cloud;
  cloud.frame = "lidar";
  for (int column = 0; column < 1800; ++column) {
    const double azimuth = column * 2 * M_PI / 1800;
    for (int ring = 0; ring < 16; ++ring) {
      const double elevation = (2 * ring - 15) * M_PI / 180;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      double range = std::min(2.5 / std::abs(ray.x()), 2.0 / std::abs(ray.y()));
      range = std::min(range, ray.z() < 0 ? -1.2 / ray.z() : 1.8 / std::max(ray.z(), 1e-9));
      const Eigen::Vector3f p = (ray * range).cast<float>();
      cloud.push(p.x() + noise(random), p.y(), p.z(), 10, static_cast<std::uint8_t>(ring),
                 0.1f * static_cast<float>(column) / 1800);
    }
  }
  return cloud;
}

ArmTrack movingArm(const RobotGeometry& geometry) {
  ArmTrack arm;
  for (int i = 0; i <= 13; ++i) {
    Vector6d q = RobotGeometry::radians(geometry.q_drive_deg);
    q[0] += 0.01 * i;
    arm.push(Stamp{} + fromSeconds(0.008 * i), q);
  }
  return arm;
}

void selfFilter(benchmark::State& state) {
  const RobotGeometry geometry = bob();
  const SelfFilter filter(geometry, {});
  const PointCloud scan = room();
  const ArmTrack arm = movingArm(geometry);
  for (auto _ : state) benchmark::DoNotOptimize(filter.filter(scan, arm));
}
BENCHMARK(selfFilter)->Unit(benchmark::kMillisecond);

void undistortScan(benchmark::State& state) {
  const RobotGeometry geometry = bob();
  const PointCloud scan = room();
  const ArmTrack arm = movingArm(geometry);
  for (auto _ : state)
    benchmark::DoNotOptimize(undistort(scan, lidarInBase(scan, geometry, arm), "base"));
}
BENCHMARK(undistortScan)->Unit(benchmark::kMillisecond);

void downsample(benchmark::State& state) {
  const PointCloud scan = room();
  for (auto _ : state)
    benchmark::DoNotOptimize(voxelDownsample(scan, static_cast<double>(state.range(0)) * 0.01));
}
BENCHMARK(downsample)->ArgName("leaf_cm")->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);

void assembleRevolution(benchmark::State& state) {
  velodyne::Vlp16Packet packet;
  std::vector<std::array<std::uint8_t, velodyne::kDataPacketBytes>> packets;
  double azimuth = 0;
  for (int i = 0; i < 76; ++i) {
    packet.timestamp_us = static_cast<std::uint32_t>(i * 1327);
    for (auto& block : packet.blocks) {
      block.azimuth = static_cast<std::uint16_t>(azimuth);
      for (auto& echo : block.returns) echo = {1000, 10};
      azimuth = std::fmod(azimuth + 39.8, 36000);
    }
    packets.push_back(velodyne::encodeVlp16Packet(packet));
  }
  velodyne::ScanAssembler assembler({});
  for (auto _ : state) {
    assembler.restart();
    for (std::size_t i = 0; i < packets.size(); ++i) {
      benchmark::DoNotOptimize(
          assembler.feed(packets[i], Stamp{} + fromSeconds(0.001327 * static_cast<double>(i))));
    }
  }
}
BENCHMARK(assembleRevolution)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
