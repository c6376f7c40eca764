#include "robot/sim/arm_hull.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "common/config/config_archive.h"
#include "tests/support/paths.h"

namespace kiln::sim {
namespace {

double toAxis(const Eigen::Vector3d& p, const Capsule& c) {
  const Eigen::Vector3d along = c.b - c.a;
  const double s = std::clamp((p - c.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - c.a - s * along).norm();
}

TEST(ArmHull, IsEnclosedByTheRobotsOwnDescription) {
  RobotGeometry robot;
  ASSERT_TRUE(loadConfig(sourceDir() + "/resources/robot_model/bob.yaml", robot));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  for (int k = 0; k < 20; ++k) {
    Vector6d q;
    for (double& joint : q) joint = angle(random);
    const auto described = robot.armCapsules(q, Eigen::Isometry3d::Identity());
    const auto frames = robot.arm.frames(q);
    for (const HullPart& part : armHull()) {
      const Eigen::Isometry3d& X = frames[static_cast<std::size_t>(part.link - 1)];
      for (int i = 0; i <= 20; ++i) {
        const Eigen::Vector3d p = X * (part.from + i / 20.0 * (part.to - part.from));
        double room = -INFINITY;
        for (const Capsule& c : described)
          room = std::max(room, c.radius - part.radius - toAxis(p, c));
        ASSERT_GE(room, 0.0) << part.name << ", " << i / 20.0 << " of its axis";
      }
    }
  }
}

}  // namespace
}  // namespace kiln::sim
