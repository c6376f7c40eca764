#include "robot/sim/wall_mjcf.h"

#include <iterator>

#include <fmt/format.h>

#include "robot/hal/gripper.h"
#include "robot/sim/mjcf.h"

namespace kiln::sim {
namespace {

std::string pose(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  return fmt::format(R"(pos="{:.9g} {:.9g} {:.9g}" quat="{:.9g} {:.9g} {:.9g} {:.9g}")",
                     X.translation().x(), X.translation().y(), X.translation().z(), q.w(), q.x(),
                     q.y(), q.z());
}

std::string size(const Eigen::Vector3d& full) {
  return fmt::format(R"(size="{:.6g} {:.6g} {:.6g}")", 0.5 * full.x(), 0.5 * full.y(),
                     0.5 * full.z());
}

double contactTime(const WorldConfig& config) {
  return 2 * config.physics.step_s + config.physics.contact_slack_s;
}

}  // namespace

std::string names::brick(std::size_t index) { return fmt::format("brick {}", index); }
std::string names::twin(std::size_t index) { return fmt::format("twin {}", index); }
std::string names::grip(std::size_t index) { return fmt::format("grip {}", index); }
std::string names::compartment(std::size_t index) { return fmt::format("compartment {}", index); }

namespace wall_mjcf {

/// A brick's friction is its own on whatever it lies: priority.
std::string bricks(const WorldConfig& config, const TrueArena& arena) {
  std::string out;
  for (std::size_t i = 0; i < arena.wall.bricks.size(); ++i) {
    const TrueBrick& brick = arena.wall.bricks[i];
    const std::string shape =
        fmt::format(R"(type="box" {} priority="1" friction="{:.4g} 0.005 0.0001")",
                    size(brick.size_m), config.wall.friction);
    fmt::format_to(
        std::back_inserter(out),
        "<body name=\"{}\" {}><freejoint/><geom name=\"brick {} #{}\" {} mass=\"{:.6g}\" "
        "contype=\"{}\" conaffinity=\"{}\"/></body>\n",
        names::brick(i), pose(brick.X_map_brick), brick.name, i, shape, brick.mass_kg, kBrickBit,
        kBrickMeets);
    fmt::format_to(
        std::back_inserter(out),
        "<body name=\"{}\" mocap=\"true\" pos=\"0 0 -20\"><geom name=\"brick {} #t{}\" {} "
        "contype=\"0\" conaffinity=\"0\"/></body>\n",
        names::twin(i), brick.name, i, shape);
  }
  return out;
}

std::string face(const WorldConfig& config, const RobotGeometry& robot) {
  Eigen::Vector2d reach = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : magnetPositions()) reach = reach.cwiseMax(p.cwiseAbs());
  // Deeper than what is seen of it, into the head's box: nothing is pulled through it in one step.
  const double thick = 0.025, r = config.wall.magnets.radius_m;
  const Eigen::Isometry3d X = robot.X_flange_tool.pose() * Eigen::Translation3d(0, 0, -0.5 * thick);
  // Sliding on it is what the force rule says: its friction wins over the brick's.
  return fmt::format(
      R"(<geom name="{}" type="box" {} {} contype="{}" conaffinity="{}" mass="0" priority="2" friction="{:.4g} 0.005 0.0001"/>)"
      "\n",
      names::kFace, size({2 * (reach.x() + r), 2 * (reach.y() + r), thick}), pose(X), kFaceBit, 1,
      config.wall.magnets.shear_n / std::max(1e-3, config.wall.magnets.flush_n));
}

std::string compartments(const WorldConfig& config, const RobotGeometry& robot) {
  std::string out;
  const StorageDeviceConfig& c = config.wall.storage;
  for (std::size_t i = 0; i < robot.storage.size(); ++i) {
    const CompartmentConfig& row = robot.storage[i];
    const auto boxes = row.boxes();
    fmt::format_to(std::back_inserter(out),
                   "<body name=\"{0}\" {1}><joint name=\"{0}\" type=\"slide\" axis=\"0 1 0\" "
                   "range=\"{2:.6g} {3:.6g}\" armature=\"{4:.4g}\" damping=\"50\"/>\n",
                   names::compartment(i), pose(row.X_base_compartment(0.0)),
                   row.travel_min_m - 0.01, row.travel_max_m + 0.01, c.rotor_kg);
    double volume = 0.0;
    for (const CompartmentBox& box : boxes) volume += box.size_m.prod();
    for (const CompartmentBox& box : boxes)
      fmt::format_to(std::back_inserter(out),
                     "<geom name=\"storage {}\" type=\"box\" {} {} contype=\"2\" conaffinity=\"3\" "
                     "priority=\"2\" friction=\"{:.4g} 0.005 0.0001\" mass=\"{:.6g}\"/>\n",
                     box.name, size(box.size_m), pose(box.X_compartment_box), c.friction,
                     c.compartment_kg * box.size_m.prod() / volume);
    out += "</body>\n";
  }
  return out;
}

std::string motors(const RobotGeometry& robot) {
  std::string out;
  for (std::size_t i = 0; i < robot.storage.size(); ++i)
    fmt::format_to(std::back_inserter(out), "<motor name=\"{0}\" joint=\"{0}\"/>\n",
                   names::compartment(i));
  return out;
}

std::string grips(const WorldConfig& config, const TrueArena& arena) {
  std::string out = "<equality>\n";
  for (std::size_t i = 0; i < arena.wall.bricks.size(); ++i)
    fmt::format_to(
        std::back_inserter(out),
        "<weld name=\"{}\" body1=\"{}\" body2=\"{}\" active=\"false\" solref=\"{:.6g} 1\" "
        "solimp=\".95 .99 .001\"/>\n",
        names::grip(i), names::kFlange, names::brick(i), contactTime(config));
  return out + "</equality>\n";
}

}  // namespace wall_mjcf
}  // namespace kiln::sim
