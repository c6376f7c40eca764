#include "robot/app/frame_tree.h"

#include <limits>

#include <gtest/gtest.h>

#include "common/config/resources.h"

namespace kiln {
namespace {

RobotGeometry bob() {
  RobotGeometry robot;
  const auto file = resourcePath("robot_model/bob.yaml");
  EXPECT_TRUE(file.has_value());
  const auto loaded = loadConfig(*file, robot);
  EXPECT_TRUE(loaded.has_value()) << loaded.error();
  return robot;
}

FrameSources whole(const RobotGeometry& robot) {
  return {Stamp{}, robot, RobotGeometry::radians(robot.q_drive_deg), Pose2{1, 2, 0.3},
          Eigen::Isometry3d(Eigen::Translation3d(3, 4, -0.17))};
}

TEST(FrameTree, OfTheShippedRobotIsWhole) {
  const RobotGeometry robot = bob();
  const auto tree = frameTree(whole(robot));
  EXPECT_EQ(static_cast<int>(tree.size()), fullTreeSize());
  EXPECT_TRUE(missingEdges(tree).empty());
  // map -> odom -> base is the pose of the base in map.
  const Eigen::Isometry3d X_map_base = tree[0].X_parent_child * tree[1].X_parent_child;
  EXPECT_TRUE(X_map_base.isApprox(*whole(robot).X_map_base, 1e-12));
}

TEST(FrameTree, AMountingThatTheFileLeavesOutIsAMissingEdge) {
  RobotGeometry robot;
  const auto loaded =
      loadYamlText("X_base_armbase: { xyz_m: [0.6, 0, 0.62] }\nX_flange_tool: { }\n", "bob.yaml",
                   ConfigNode{[&](ConfigArchive& a) { robot.visit(a); }});
  ASSERT_TRUE(loaded.has_value()) << loaded.error();
  EXPECT_EQ(missingEdges(frameTree(whole(robot))),
            (std::vector<std::string>{"base -> operator_camera", "flange -> lidar",
                                      "flange -> thermal", "flange -> rgb", "flange -> nozzle"}));
}

TEST(FrameTree, ADeviceThatDoesNotReportIsAMissingEdge) {
  const RobotGeometry robot = bob();
  FrameSources sources = whole(robot);
  sources.q.reset();
  EXPECT_EQ(missingEdges(frameTree(sources)), std::vector<std::string>{"base -> flange"});
  sources.X_odom_base.reset();
  EXPECT_EQ(missingEdges(frameTree(sources)),
            (std::vector<std::string>{"map -> odom", "odom -> base", "base -> flange"}));
}

TEST(FrameTree, APoseThatIsNotANumberIsNoEdge) {
  const RobotGeometry robot = bob();
  FrameSources sources = whole(robot);
  sources.X_odom_base->yaw_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(missingEdges(frameTree(sources)),
            (std::vector<std::string>{"map -> odom", "odom -> base"}));
}

}  // namespace
}  // namespace kiln
