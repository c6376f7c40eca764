#include "robot/planning/storage/storage_room.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kGravity_mps2 = 9.81;

/// A box of a compartment between two corners in its frame.
OrientedBox boxBetween(const CompartmentConfig& row, double position_m,
                       const Eigen::Vector3d& least, const Eigen::Vector3d& most,
                       std::string name) {
  return makeBox(row.X_base_compartment(position_m) * Eigen::Translation3d(0.5 * (least + most)),
                 most - least, std::move(name));
}

double halfWidth(const CompartmentConfig& row) {
  return 0.5 * (row.bins * row.pitch() + row.sheet_m);
}

/// Everything that a full compartment fills while it travels between two positions.
OrientedBox envelope(const CompartmentConfig& row, const StorageConfig& config, double from_m,
                     double to_m) {
  const double side = halfWidth(row);
  const double top = std::max(row.wall_height_m, config.max_stack_m);
  return boxBetween(row, 0.0, {0.0, from_m - side, -row.sheet_m},
                    {row.bin_depth_m + row.sheet_m, to_m + side, top}, row.name);
}

/// What a brick and the gripper before it fill on the way from the front into a bin.
OrientedBox insertion(const CompartmentConfig& row, const StorageConfig& config, double position_m,
                      const Seat& seat, double length_m) {
  const double half = 0.5 * (kBrickSide_m + config.brick_tolerance_m), y = row.binY(seat.bin);
  return boxBetween(row, position_m, {-config.insertion_m, y - half, seat.height_m},
                    {row.bin_depth_m, y + half, seat.height_m + length_m + config.lift_m},
                    "a brick on its way in");
}

bool clear(const OrientedBox& a, const OrientedBox& b, double clearance_m) {
  const Eigen::Vector3d spare = Eigen::Vector3d::Constant(clearance_m);
  if (!Eigen::AlignedBox3d(a.bounds.min() - spare, a.bounds.max() + spare).intersects(b.bounds))
    return true;
  return distance(a, b) >= clearance_m;
}

OrientedBox bodyBox(const BoxConfig& box) {
  return makeBox(box.center.pose(), {box.size_m[0], box.size_m[1], box.size_m[2]}, box.name);
}

tl::unexpected<Error> touches(const std::string& one, const std::string& other,
                              const StorageConfig& config) {
  return makeError(ErrorCode::InvalidInput,
                   "storage: {} does not keep {:.0f} mm from {}; move or shorten one of them", one,
                   1e3 * config.clearance_m, other);
}

Result<void> checkRow(const CompartmentConfig& row, const StorageConfig& config) {
  const double widest = kBrickSide_m + config.brick_tolerance_m;
  if (row.bin_width_m < widest + 2.0 * config.bin_clearance_m)
    return makeError(ErrorCode::InvalidInput,
                     "storage: bins of {} are {:.1f} mm wide; a brick needs {:.1f} mm", row.name,
                     1e3 * row.bin_width_m, 1e3 * (widest + 2.0 * config.bin_clearance_m));
  if (std::atan2(config.brake_mps2, kGravity_mps2) >= row.incline_deg * kDeg)
    return makeError(ErrorCode::InvalidInput,
                     "storage: bricks slide out of {} when the base brakes with {:.1f} m/s2; its "
                     "floor is inclined by {:.1f} deg only",
                     row.name, config.brake_mps2, row.incline_deg);
  return {};
}

}  // namespace

void StorageConfig::visit(ConfigArchive& a) {
  a.field("max_stack_m", max_stack_m, "m", 0.3, 3.0, "top of a stack above the bin's floor");
  a.field("brake_mps2", brake_mps2, "m/s2", 0.0, 9.0, "of the base, that stacks must stand");
  a.field("clearance_m", clearance_m, "m", 0.0, 0.2, "between what must not touch");
  a.field("bin_clearance_m", bin_clearance_m, "m", 0.0, 0.05, "brick to the walls of its bin");
  a.field("brick_tolerance_m", brick_tolerance_m, "m", 0.0, 0.05, "bricks may be so much larger");
  a.field("insertion_m", insertion_m, "m", 0.2, 1.0, "brick and gripper before the row");
  a.field("lift_m", lift_m, "m", 0.01, 0.3, "a brick is set in so far above its place");
  a.field("before_m", before_m, "m", 0.1, 0.8, "way into a bin: from so far before it");
  a.field("front_m", front_m, "m", 0.0, 0.1, "a brick is let go so far before its place");
  a.field("travel_step_m", travel_step_m, "m", 0.01, 1.0, "between positions looked at");
}

Result<void> StorageConfig::validate() const {
  for (const double value : {max_stack_m, brake_mps2, clearance_m, bin_clearance_m,
                             brick_tolerance_m, insertion_m, lift_m, before_m, front_m})
    if (!(std::isfinite(value) && value >= 0.0))
      return makeError(ErrorCode::InvalidInput, "storage: no length of its config may be negative");
  if (!(travel_step_m >= 0.01))
    return makeError(ErrorCode::InvalidInput, "storage: travel_step_m must be 0.01 m or more");
  return {};
}

std::string describe(const StorageRoom& room, const Seat& seat) {
  return fmt::format("bin {} of {}", seat.bin + 1, room.rows[seat.compartment].name);
}

Eigen::Isometry3d X_base_stored(const StorageRoom& room, const StoragePosture& posture,
                                const Seat& seat, BrickKind kind) {
  const CompartmentConfig& row = room.rows[seat.compartment];
  Eigen::Isometry3d X_compartment_brick = Eigen::Isometry3d::Identity();
  X_compartment_brick.translation() << row.bin_depth_m - 0.5 * kBrickSide_m, row.binY(seat.bin),
      seat.height_m + 0.5 * brickShape(kind).length_m;
  // X up, Z (the plate) to the front, which is -X of the compartment.
  X_compartment_brick.linear() << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  return row.X_base_compartment(posture[seat.compartment]) * X_compartment_brick;
}

StorageRoom StorageRoom::of(const RobotGeometry& robot) {
  return {robot.storage, robot.body, &robot};
}

Eigen::Isometry3d X_base_at(const StorageRoom& room, const StoragePosture& posture,
                            const Seat& seat, BrickKind kind, double out_m, double up_m) {
  const Eigen::Isometry3d X = X_base_stored(room, posture, seat, kind);
  return Eigen::Translation3d(out_m * X.linear().col(2) + up_m * X.linear().col(0)) * X;
}

std::vector<Eigen::Isometry3d> seatWay(const StorageRoom& room, const StorageConfig& config,
                                       const StoragePosture& posture, const Seat& seat,
                                       BrickKind kind) {
  constexpr double kDoor_m = 0.02, kMouth_m = 0.03;  // before and behind the edges of its walls
  const double edge_m = room.rows[seat.compartment].bin_depth_m;
  std::vector<Eigen::Isometry3d> way;
  for (const double out_m :
       {config.before_m, edge_m + kDoor_m, edge_m - kMouth_m, 2.0 * config.front_m})
    way.push_back(X_base_at(room, posture, seat, kind, out_m, config.lift_m));
  return way;
}

std::string stackFault(const StorageRoom& room, const StorageConfig& config,
                       std::size_t compartment, std::span<const BrickKind> stack) {
  const CompartmentConfig& row = room.rows[compartment];
  const double lean = row.incline_deg * kDeg + std::atan2(config.brake_mps2, kGravity_mps2);
  const double highest = row.wall_height_m + 0.5 * kBrickSide_m / std::tan(lean);
  double below = 0.0;
  for (const BrickKind kind : stack) {
    const double length = brickShape(kind).length_m;
    if (below + 0.5 * length > highest)
      return fmt::format(
          "the {} brick on {:.1f} m would have its centre {:.2f} m high and tip over "
          "the back when the base brakes (at most {:.2f} m)",
          brickShape(kind).name, below, below + 0.5 * length, highest);
    below += length;
    if (below > config.max_stack_m + 1e-9)
      return fmt::format("the {} brick would end {:.1f} m high (at most {:.1f} m)",
                         brickShape(kind).name, below, config.max_stack_m);
  }
  return {};
}

Result<void> checkRoom(const StorageRoom& room, const StorageConfig& config) {
  if (auto valid = config.validate(); !valid) return valid;
  for (std::size_t i = 0; i < room.rows.size(); ++i) {
    const CompartmentConfig& row = room.rows[i];
    if (auto checked = checkRow(row, config); !checked) return checked;
    const OrientedBox full = envelope(row, config, row.travel_min_m, row.travel_max_m);
    for (std::size_t k = 0; k < i; ++k) {
      const CompartmentConfig& other = room.rows[k];
      if (!clear(full, envelope(other, config, other.travel_min_m, other.travel_max_m),
                 config.clearance_m))
        return touches(row.name, other.name, config);
    }
    for (const BoxConfig& box : room.body)
      if (!clear(full, bodyBox(box), config.clearance_m))
        return touches(row.name, box.name, config);
  }
  return {};
}

std::string fixedFault(const StorageRoom& room, const StorageConfig& config, double position_m,
                       const Seat& seat, BrickKind kind) {
  const OrientedBox way =
      insertion(room.rows[seat.compartment], config, position_m, seat, brickShape(kind).length_m);
  for (const BoxConfig& box : room.body)
    if (!clear(way, bodyBox(box), config.clearance_m))
      return box.name + " stands in the way to the front";
  return armFault(room, config, position_m, seat, kind);
}

bool bars(const StorageRoom& room, const StorageConfig& config, std::size_t other,
          double other_position_m, const Seat& seat, double position_m) {
  const Seat floor{seat.compartment, seat.bin, 0.0};
  return !clear(
      insertion(room.rows[seat.compartment], config, position_m, floor, config.max_stack_m),
      envelope(room.rows[other], config, other_position_m, other_position_m), config.clearance_m);
}

std::string accessFault(const StorageRoom& room, const StorageConfig& config,
                        const StoragePosture& posture, const Seat& seat, BrickKind kind) {
  const double position_m = posture[seat.compartment];
  if (std::string fault = fixedFault(room, config, position_m, seat, kind); !fault.empty())
    return fault;
  const OrientedBox way =
      insertion(room.rows[seat.compartment], config, position_m, seat, brickShape(kind).length_m);
  for (std::size_t i = 0; i < room.rows.size(); ++i)
    if (i != seat.compartment &&
        !clear(way, envelope(room.rows[i], config, posture[i], posture[i]), config.clearance_m))
      return room.rows[i].name + " stands in the way to the front";
  return {};
}

std::vector<OrientedBox> storageBoxes(const StorageRoom& room, const StoragePosture& posture,
                                      std::span<const StoredBrick> stored) {
  std::vector<OrientedBox> boxes;
  for (std::size_t i = 0; i < room.rows.size(); ++i) {
    const Eigen::Isometry3d X = room.rows[i].X_base_compartment(posture[i]);
    for (const CompartmentBox& box : room.rows[i].boxes())
      boxes.push_back(makeBox(X * box.X_compartment_box, box.size_m, box.name));
  }
  for (const StoredBrick& brick : stored)
    boxes.push_back(makeBox(
        X_base_stored(room, posture, brick.seat, brick.kind),
        {brickShape(brick.kind).length_m, kBrickSide_m, kBrickSide_m},
        fmt::format("{} brick in {}", brickShape(brick.kind).name, describe(room, brick.seat))));
  return boxes;
}

}  // namespace kiln
