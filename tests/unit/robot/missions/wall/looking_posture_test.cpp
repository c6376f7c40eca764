#include "robot/missions/wall/looking_posture.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/planning/arm_motion/arm_collision.h"

namespace kiln {
namespace {

class LookingPosture : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    auto loaded = loadResource<RobotGeometry>(std::string("robot_model/") + GetParam());
    ASSERT_TRUE(loaded) << loaded.error();
    robot = *loaded;
  }
  template <class Check>
  void everywhere(Check check) {
    for (const double pan : {-25.0, 0.0, 25.0})
      for (const double tilt : {8.0, 18.0, 27.0, 36.0, 42.0}) check(pan, tilt);
  }
  RobotGeometry robot;
};

TEST_P(LookingPosture, CameraLooksWhereItIsTold) {
  everywhere([&](double pan, double tilt) {
    const Eigen::Isometry3d X =
        robot.X_base_flange(lookingPosture(pan * kDeg, tilt * kDeg)) * robot.X_flange_rgb.pose();
    const Eigen::Vector3d view = X.linear().col(2);
    EXPECT_NEAR(X.translation().z(), 1.72, 0.13);
    EXPECT_NEAR(std::asin(-view.z()) / kDeg, tilt, 1e-6);
    EXPECT_NEAR(std::atan2(view.y(), view.x()) / kDeg, pan, 1e-6);
    EXPECT_NEAR(X.linear()(2, 0), 0.0, 1e-9);  // the picture stands upright,
    EXPECT_LT(X.linear()(2, 1), 0.0);          // with its upper side up
  });
}

/// What a motion asks for, and half of it again: pans and tilts are straight joint moves.
TEST_P(LookingPosture, HeadStaysClearOfArmAndBody) {
  ArmCollision collision(robot);
  collision.setScene({}, {});
  everywhere([&](double pan, double tilt) {
    const Clearance clear = collision.clearance(lookingPosture(pan * kDeg, tilt * kDeg));
    EXPECT_GT(clear.distance_m, 0.045) << pan << " " << tilt << ": " << clear.what;
  });
}

INSTANTIATE_TEST_SUITE_P(Robots, LookingPosture,
                         ::testing::Values("mario.yaml", "bob_wall.yaml", "bob.yaml"));

}  // namespace
}  // namespace kiln
