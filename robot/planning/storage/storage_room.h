#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/config/config_archive.h"
#include "common/core/error.h"
#include "common/robot_model/robot_geometry.h"
#include "common/robot_model/storage_geometry.h"
#include "robot/planning/arm_motion/shapes.h"
#include "robot/scene/brick.h"

namespace kiln {

/// What may stand in a bin and how it is set in. The stack rule is one of statics: a brick is held
/// by walls and back up to their top, and tips over the back when its centre lies too far above it
/// while the base brakes. With the defaults and the paper's bins that is 4 red, 2 green, 1 blue or
/// 1 orange (paper, "Storage System"), and of mixed stacks those with the long brick on top.
struct StorageConfig {
  double max_stack_m = 1.8;          ///< top of a stack above the floor: an orange brick
  double brake_mps2 = 2.0;           ///< of the base, in any direction
  double clearance_m = 0.005;        ///< between what must not touch
  double bin_clearance_m = 0.001;    ///< the same between a brick and the walls of its own bin
  double brick_tolerance_m = 0.002;  ///< bricks are up to so much larger or smaller
  double insertion_m = 0.45;  ///< way to the front that brick and gripper need before the row
  double lift_m = 0.06;       ///< a brick is set in so far above its place
  double before_m = 0.35;     ///< the arm's straight way into a bin begins so far before it
  double front_m = 0.01;      ///< a brick is let go so far before its place and slides back into it
  double travel_step_m = 0.05;  ///< between positions of a compartment that are looked at
  void visit(ConfigArchive& a);
  [[nodiscard]] Result<void> validate() const;
};

/// The compartments on a robot and what stands around them, in base.
struct StorageRoom {
  std::vector<CompartmentConfig> rows;
  std::vector<BoxConfig> body;           ///< deck and what is fixed to it
  const RobotGeometry* robot = nullptr;  ///< whose arm it is, outlives this; nullptr: reaches all
  /// As the robot's description has it.
  [[nodiscard]] static StorageRoom of(const RobotGeometry& robot);
};

/// Position of each compartment along its travel, m.
using StoragePosture = std::vector<double>;

/// A place in the storage. `height_m`: what stands below it in its bin.
struct Seat {
  std::size_t compartment = 0;
  int bin = 0;
  double height_m = 0.0;
};

/// "bin 3 of compartment 1", counted from 1.
[[nodiscard]] std::string describe(const StorageRoom& room, const Seat& seat);

/// Where a stored brick is: upright, its plate to the front, its back against the bin's.
[[nodiscard]] Eigen::Isometry3d X_base_stored(const StorageRoom& room,
                                              const StoragePosture& posture, const Seat& seat,
                                              BrickKind kind);

/// The brick's way from before a bin to above its place there, on straight lines: before it, at its
/// door, in its mouth, inside. From the last pose it is lowered. Taken out it goes back.
[[nodiscard]] std::vector<Eigen::Isometry3d> seatWay(const StorageRoom& room,
                                                     const StorageConfig& config,
                                                     const StoragePosture& posture,
                                                     const Seat& seat, BrickKind kind);
/// The brick so far before its place and above it.
[[nodiscard]] Eigen::Isometry3d X_base_at(const StorageRoom& room, const StoragePosture& posture,
                                          const Seat& seat, BrickKind kind, double out_m,
                                          double up_m);

/// Empty, or why these bricks, from the floor up, may not stand in one bin.
[[nodiscard]] std::string stackFault(const StorageRoom& room, const StorageConfig& config,
                                     std::size_t compartment, std::span<const BrickKind> stack);

/// All compartments with all bins full, over their whole travel, keep clear of each other and of
/// the body, and each bin takes a brick of the largest size. Then no move of a compartment touches
/// anything, whatever is stored. Error: InvalidInput, names what touches what.
[[nodiscard]] Result<void> checkRoom(const StorageRoom& room, const StorageConfig& config);

/// Empty, or why a brick of this kind cannot be set into, or taken from, this seat with the
/// compartments standing so: its way to the front is barred (all other bins taken as full), or the
/// arm cannot lead it along seatWay() (armFault()). How the arm comes to where that begins is planned
/// by whoever moves it.
[[nodiscard]] std::string accessFault(const StorageRoom& room, const StorageConfig& config,
                                      const StoragePosture& posture, const Seat& seat,
                                      BrickKind kind);

/// accessFault() in parts, for a search over postures. Whatever the other compartments do: out of
/// reach, or something of the body stands in the way; empty: neither.
[[nodiscard]] std::string fixedFault(const StorageRoom& room, const StorageConfig& config,
                                     double position_m, const Seat& seat, BrickKind kind);
/// Empty, or why the arm cannot lead a brick of this kind, gripped at its middle, along seatWay() and
/// down into this seat in one posture of the wrist: by inverse kinematics along the lines, without
/// touching the robot, itself or the row of the seat, whose other bins are full.
[[nodiscard]] std::string armFault(const StorageRoom& room, const StorageConfig& config,
                                   double position_m, const Seat& seat, BrickKind kind);
/// Another compartment stands in the way of the tallest stack into this bin.
[[nodiscard]] bool bars(const StorageRoom& room, const StorageConfig& config, std::size_t other,
                        double other_position_m, const Seat& seat, double position_m);

/// Walls, floors, backs and stored bricks as obstacles, in base, by name.
struct StoredBrick {
  BrickKind kind = BrickKind::Red;
  Seat seat;
};
[[nodiscard]] std::vector<OrientedBox> storageBoxes(const StorageRoom& room,
                                                    const StoragePosture& posture,
                                                    std::span<const StoredBrick> stored);

}  // namespace kiln
