#include <optional>

#include "robot/planning/arm_motion/cartesian_path.h"
#include "robot/planning/arm_motion/ur_inverse.h"
#include "robot/planning/storage/storage_room.h"

namespace kiln {
namespace {

// More than the motions themselves keep: the brick hangs off the middle by as much as a centimetre.
constexpr double kFree_m = 0.03, kOnLine_m = 0.008;
constexpr double kStep_m = 0.05;  // along the lines

/// What fills a bin of the row up to where bricks may end, from `from_m` above its floor.
OrientedBox filled(const CompartmentConfig& row, double position_m, int bin, double from_m,
                   double to_m) {
  const Eigen::Vector3d middle(0.5 * row.bin_depth_m, row.binY(bin), 0.5 * (from_m + to_m));
  return makeBox(row.X_base_compartment(position_m) * Eigen::Translation3d(middle),
                 {kBrickSide_m, kBrickSide_m, to_m - from_m},
                 fmt::format("bricks in bin {}", bin + 1));
}

ArmScene rowAround(const StorageRoom& room, const StorageConfig& config, double position_m,
                   const Seat& seat) {
  const CompartmentConfig& row = room.rows[seat.compartment];
  ArmScene scene;
  for (const CompartmentBox& box : row.boxes())
    scene.boxes.push_back(
        makeBox(row.X_base_compartment(position_m) * box.X_compartment_box, box.size_m, box.name));
  for (int bin = 0; bin < row.bins; ++bin) {
    if (bin != seat.bin)
      scene.boxes.push_back(filled(row, position_m, bin, 0.0, config.max_stack_m));
    else if (seat.height_m > 0.0)
      scene.boxes.push_back(filled(row, position_m, bin, 0.0, seat.height_m));
  }
  // Brick and gripper touch what is beside them; the arm's links must not.
  for (const OrientedBox& box : scene.boxes) scene.touchable.push_back(box.name);
  return scene;
}

}  // namespace

std::string armFault(const StorageRoom& room, const StorageConfig& config, double position_m,
                     const Seat& seat, BrickKind kind) {
  if (!room.robot) return {};
  const RobotGeometry& robot = *room.robot;
  StoragePosture posture(room.rows.size(), 0.0);
  posture[seat.compartment] = position_m;
  std::vector<Eigen::Isometry3d> way = seatWay(room, config, posture, seat, kind);
  way.push_back(X_base_at(room, posture, seat, kind, 2.0 * config.front_m, 0.0));
  // The face flush on the plate: its Z against the brick's.
  const Eigen::Isometry3d X_brick_face =
      Eigen::Translation3d(0, 0, 0.5 * kBrickSide_m) *
      Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  const Eigen::Isometry3d X_face_flange = robot.X_flange_tool.pose().inverse();
  ArmCollision world(robot);
  world.setScene({}, {}, rowAround(room, config, position_m, seat));
  world.setCarried(makeBox((X_brick_face * X_face_flange).inverse(),
                           {brickShape(kind).length_m, kBrickSide_m, kBrickSide_m}, "brick"));
  CartesianPathConfig lines;
  lines.step_m = kStep_m;
  lines.clearance_m = kOnLine_m;
  lines.max_joint_step_rad = 0.5;
  std::string why = "out of the arm's reach";
  for (const double turn : {0.0, M_PI}) {
    std::vector<Eigen::Isometry3d> X_base_flange;
    for (const Eigen::Isometry3d& X : way)
      X_base_flange.emplace_back(X * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
                                 X_brick_face * X_face_flange);
    const Eigen::Isometry3d X_armbase_base = robot.X_base_armbase.pose().inverse();
    for (const Vector6d& q : inverseSolutions(robot.arm, X_armbase_base * X_base_flange.front())) {
      const Clearance room_there = world.clearance(q);
      if (room_there.distance_m < kFree_m) {
        why = "before the bin: " + room_there.what;
        continue;
      }
      const auto paths = cartesianPaths(robot, world, lines, q,
                                        {X_base_flange.begin() + 1, X_base_flange.end()}, false);
      if (paths) return {};
      why = paths.error().message;
    }
  }
  return why;
}

}  // namespace kiln
