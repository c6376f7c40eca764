#include "robot/app/frame_tree.h"

#include <algorithm>
#include <array>

#include "common/geom/frames.h"

namespace kiln {
namespace {

struct Edge {
  const char* parent;
  const char* child;
};

constexpr std::array kEdges = {
    Edge{frames::kMap, frames::kOdom},       Edge{frames::kOdom, frames::kBase},
    Edge{frames::kBase, frames::kArmBase},   Edge{frames::kBase, frames::kOperatorCamera},
    Edge{frames::kBase, frames::kFlange},    Edge{frames::kFlange, frames::kLidar},
    Edge{frames::kFlange, frames::kThermal}, Edge{frames::kFlange, frames::kRgb},
    Edge{frames::kFlange, frames::kNozzle},  Edge{frames::kFlange, frames::kTool}};

}  // namespace

std::vector<foxglove::FrameTransform> frameTree(const FrameSources& from) {
  std::vector<foxglove::FrameTransform> tree;
  const auto add = [&](const char* parent, const char* child, const Eigen::Isometry3d& X) {
    if (X.matrix().allFinite()) tree.push_back({from.stamp, parent, child, X});
  };
  const auto mounted = [&](const char* parent, const char* child, const PoseConfig& mounting) {
    if (mounting.stated) add(parent, child, mounting.pose());
  };
  const RobotGeometry& robot = from.robot;
  if (from.X_odom_base) {
    if (from.X_map_base)
      add(frames::kMap, frames::kOdom, *from.X_map_base * toIsometry(inverse(*from.X_odom_base)));
    add(frames::kOdom, frames::kBase, toIsometry(*from.X_odom_base));
  }
  mounted(frames::kBase, frames::kArmBase, robot.X_base_armbase);
  mounted(frames::kBase, frames::kOperatorCamera, robot.X_base_operatorcamera);
  if (from.q && robot.X_base_armbase.stated)
    add(frames::kBase, frames::kFlange, robot.X_base_flange(*from.q));
  mounted(frames::kFlange, frames::kLidar, robot.X_flange_lidar);
  mounted(frames::kFlange, frames::kThermal, robot.X_flange_thermal);
  mounted(frames::kFlange, frames::kRgb, robot.X_flange_rgb);
  mounted(frames::kFlange, frames::kNozzle, robot.X_flange_nozzle);
  mounted(frames::kFlange, frames::kTool, robot.X_flange_tool);
  return tree;
}

std::vector<std::string> missingEdges(std::span<const foxglove::FrameTransform> tree) {
  std::vector<std::string> missing;
  for (const Edge& edge : kEdges) {
    const bool there = std::any_of(tree.begin(), tree.end(), [&](const auto& transform) {
      return transform.parent == edge.parent && transform.child == edge.child;
    });
    if (!there) missing.push_back(std::string(edge.parent) + " -> " + edge.child);
  }
  return missing;
}

int fullTreeSize() { return static_cast<int>(kEdges.size()); }

}  // namespace kiln
