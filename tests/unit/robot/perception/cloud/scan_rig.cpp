#include "tests/unit/robot/perception/cloud/scan_rig.h"

#include <gtest/gtest.h>

#include "common/config/resources.h"

namespace kiln {
namespace {
constexpr double kChunk = 0.02, kSample = 0.008;  // s
}

ScanRig::ScanRig(std::uint64_t seed, bool perturbed) {
  if (!perturbed) config.perturbation = {0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(loadConfig(*resourcePath("robot_model/bob.yaml"), robot).has_value());
  arena = sim::TrueArena::draw(config, map, site, robot, seed);
  scene = std::make_unique<sim::RayScene>(config, arena, robot, false);
  lidar = std::make_unique<sim::LidarSensor>(config.lidar, robot, arena.robot, seed);
}

PointCloudPtr ScanRig::scan(double t_s, const std::function<Motion(double)>& motion) {
  const auto state = [&](double t) {
    const Motion m = motion(t);
    sim::SceneState s;
    s.stamp = Stamp{} + fromSeconds(t);
    s.X_map_base = toIsometry(m.X_map_base);
    s.q = m.q;
    return s;
  };
  lidar->restart();
  for (double t = t_s - kChunk;; t += kChunk) {
    scene->update(state(t + 0.5 * kChunk));
    if (auto scan = lidar->advance(state(t), state(t + kChunk), *scene)) return scan;
  }
}

ScanRig::Tracks ScanRig::tracksOf(const PointCloud& scan,
                                  const std::function<Motion(double)>& motion) const {
  Tracks out;
  const double begin = toSeconds(scan.stamp);
  const Pose2 X_base0_map = inverse(motion(begin).X_map_base);
  for (double dt = 0.0; dt <= 0.1 + kSample; dt += kSample) {
    const Motion m = motion(begin + dt);
    const Stamp t = scan.stamp + fromSeconds(dt);
    out.arm.push(t, m.q);
    out.X_base0_lidar.push(t, toIsometry(X_base0_map * m.X_map_base) * robot.X_base_flange(m.q) *
                                  robot.X_flange_lidar.pose());
  }
  return out;
}

PointCloud ScanRig::prepare(const PointCloud& scan,
                            const std::function<Motion(double)>& motion) const {
  const Tracks tracks = tracksOf(scan, motion);
  const SelfFilter filter(robot, {});
  return undistort(filter.filter(scan, tracks.arm).cloud, tracks.X_base0_lidar, "base");
}

}  // namespace kiln
