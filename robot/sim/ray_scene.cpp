#include "robot/sim/ray_scene.h"

#include <algorithm>
#include <cmath>

#include "robot/scene/primitive_meshes.h"
#include "robot/sim/arm_hull.h"
#include "robot/sim/mjcf.h"

namespace kiln::sim {
namespace {

constexpr std::size_t kMaxDrops = 96;
constexpr double kDropRadius =
    0.009;  // drawn larger than the true 4 mm, else a drop is no pixel wide
constexpr int kFlameStrips = 5;
constexpr double kPersonHeight = 1.75, kPersonRadius = 0.22;
constexpr double kClothes_c = 30.0;
constexpr double kBoardDistance = 0.5;  // beyond the LiDAR's least range

std::uint32_t number(Material m) { return static_cast<std::uint32_t>(m); }

Eigen::Isometry3d alongZ(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = 0.5 * (from + to);
  X.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from).toRotationMatrix();
  return X;
}

std::uint32_t arenaMask(Material m) {
  if (m == Material::Acrylic) return mask::kAcrylic;
  if (m == Material::WarmPatch) return mask::kWarmPatch;
  return mask::kSolid;
}

}  // namespace

RayScene::RayScene(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
                   bool with_drops)
    : robot_(robot),
      fire_(config.fire),
      rounding_m_(config.perturbation.rounding_m),
      X_flange_lidar_(arena.robot.X_flange_lidar) {
  addArena(arena);
  for (const TrueFirePlace& place : arena.fire_places) addFirePlace(place);
  addRobot(arena);
  addStorage(arena.wall.present());
  addBricks(arena);
  for (std::size_t i = 0; with_drops && i < kMaxDrops; ++i) {
    drops_.push_back(note(rays_.addSphere(kDropRadius, {0, 0, -5}, number(Material::Water), 0),
                          fire_.ambient_c));
  }
  addDisturbances(config);
  obstacle_ = note(rays_.addBox(Eigen::Vector3d::Constant(kObstacleSize_m),
                                Eigen::Isometry3d::Identity(), number(Material::Obstacle), 0),
                   fire_.ambient_c);
  update(SceneState{});
}

Raycaster::Id RayScene::note(Raycaster::Id id, double temperature_c) {
  temperature_c_.resize(id + 1, fire_.ambient_c);
  temperature_c_[id] = temperature_c;
  return id;
}

void RayScene::addArena(const TrueArena& arena) {
  for (const SolidBox& b : arena.ground_boxes)
    note(rays_.addBox(b.size_m, b.X_map_box, number(b.material), arenaMask(b.material)),
         b.temperature_c);
  for (const SolidBox& b : arena.boxes) {
    boxes_.push_back(addSolid(b));
    X_map_boxes_.push_back(b.X_map_box);
  }
}

/// Edges are never sharp; sheets are cut square.
Raycaster::Id RayScene::addSolid(const SolidBox& b) {
  const std::uint32_t bits = arenaMask(b.material);
  if (rounding_m_ <= 0.0 || b.size_m.minCoeff() < 4.0 * rounding_m_)
    return note(rays_.addBox(b.size_m, b.X_map_box, number(b.material), bits), b.temperature_c);
  // A cut at 45 degrees that touches the round edge in its middle.
  const TriangleMesh mesh = cutBox(b.size_m, (2.0 - M_SQRT2) * rounding_m_);
  return note(rays_.addMesh(mesh.vertices, mesh.triangles, b.X_map_box, number(b.material), bits),
              b.temperature_c);
}

std::optional<std::size_t> RayScene::box(const Raycaster::Hit& hit) const {
  // They were added one after another.
  if (boxes_.empty() || hit.instance < boxes_.front() || hit.instance > boxes_.back())
    return std::nullopt;
  return hit.instance - boxes_.front();
}

/// The front panel with its round opening: opaque rim, then acrylic up to the frame.
void RayScene::addFront(const TrueFirePlace& place) {
  const double hole = 0.5 * place.opening_m, acrylic = hole + place.rim_m;
  const auto add = [&](const TriangleMesh& mesh, Material m) {
    note(rays_.addMesh(mesh.vertices, mesh.triangles, place.X_map_front, number(m), arenaMask(m)),
         fire_.ambient_c);
  };
  add(holedPlate(hole, Outline::Round, acrylic, place.acrylic_m + 0.003), Material::Frame);
  add(holedPlate(acrylic, Outline::Square, 0.5 * place.box_m - place.frame_m, place.acrylic_m),
      Material::Acrylic);
}

void RayScene::addFirePlace(const TrueFirePlace& place) {
  for (const SolidBox& b : place.boxes) {
    if (b.visible) addSolid(b);
  }
  addFront(place);
  const Eigen::Vector3d p = place.p_front_plate;
  const Eigen::Isometry3d X_plate = place.X_map_front * alongZ(p - Eigen::Vector3d(0.01, 0, 0), p);
  const auto plate = note(
      rays_.addCylinder(0.5 * place.plate_m, 0.01, X_plate, number(Material::Plate), mask::kSolid),
      fire_.ambient_c);
  if (!place.burning) return;
  burning_plate_.push_back(plate);
  X_map_fire_ = place.X_map_front;
  p_front_plate_ = p;
  plate_m_ = place.plate_m;
  reflection_ratio_ = place.reflection_ratio;
  for (int i = 0; i < kFlameStrips; ++i) {
    flame_.push_back(
        note(rays_.addBox({0.004, 0.025, 0.16}, X_map_fire_, number(Material::Flame), mask::kSilk),
             fire_.flame_c));
  }
  // The front panel mirrors part of the plate beside the opening: an infrared ghost, cooler than
  // the plate.
  const double side = 0.5 * place.opening_m + 0.055;
  const Eigen::Vector3d ghost(0.001, side, 0.03);
  const Eigen::Isometry3d X_ghost =
      X_map_fire_ * alongZ(ghost, ghost + Eigen::Vector3d(0.001, 0, 0));
  reflection_.push_back(
      note(rays_.addCylinder(0.035, 0.001, X_ghost, number(Material::Reflection), mask::kWarmPatch),
           fire_.ambient_c));
}

void RayScene::addCapsule(int link, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                          double radius, Material m) {
  const auto add = [&](Raycaster::Id id, const Eigen::Isometry3d& X) {
    moving_.push_back({note(id, fire_.ambient_c), link, X});
  };
  const Eigen::Isometry3d X = alongZ(from, to);
  add(rays_.addCylinder(radius, (to - from).norm(), X, number(m), mask::kRobot), X);
  const Material joint = m == Material::ArmLink ? Material::ArmJoint : m;
  for (const Eigen::Vector3d& end : {from, to}) {
    add(rays_.addSphere(1.02 * radius, end, number(joint), mask::kRobot),
        Eigen::Isometry3d(Eigen::Translation3d(end)));
  }
}

void RayScene::addRobot(const TrueArena& arena) {
  const auto box = [&](const BoxConfig& part, int link, Material m, std::uint32_t bits) {
    const Eigen::Vector3d size(part.size_m[0], part.size_m[1], part.size_m[2]);
    const Eigen::Isometry3d X = part.center.pose();
    moving_.push_back({note(rays_.addBox(size, X, number(m), bits), fire_.ambient_c), link, X});
  };
  for (const BoxConfig& part : robot_.body) {
    box(part, 0, part.name.starts_with("tank") ? Material::Tank : Material::Chassis, mask::kRobot);
  }
  for (const HullPart& part : armHull())
    addCapsule(part.link, part.from, part.to, part.radius, part.material);
  for (const BoxConfig& part : robot_.head) {
    box(part, 6, Material::Head, part.name == "lidar" ? mask::kLidarHousing : mask::kGripper);
  }
  const Eigen::Vector3d tip = arena.robot.X_flange_nozzle.translation();
  addCapsule(6, tip - 0.10 * arena.robot.X_flange_nozzle.linear().col(0),
             tip - Eigen::Vector3d(0, 0, 0.01), 0.01, Material::Hose);
  addWheels();
}

void RayScene::addWheels() {
  for (Raycaster::Id& wheel : wheels_) {
    wheel = note(rays_.addCylinder(robot_.wheel_radius_m, 0.05, Eigen::Isometry3d::Identity(),
                                   number(Material::Wheel), mask::kRobot),
                 fire_.ambient_c);
  }
}

void RayScene::addBricks(const TrueArena& arena) {
  for (const TrueBrick& brick : arena.wall.bricks) {
    bricks_.push_back(addSolid({brick.name, brickMaterial(brick.kind), brick.X_map_brick,
                                brick.size_m, true, fire_.ambient_c}));
    X_map_bricks_.push_back(brick.X_map_brick);
  }
}

/// The compartments, and the face of the magnets as a plate.
void RayScene::addStorage(bool face) {
  const auto add = [&](const Eigen::Vector3d& size, Material m, std::uint32_t bits) {
    return note(rays_.addBox(size, Eigen::Isometry3d::Identity(), number(m), bits),
                fire_.ambient_c);
  };
  for (std::size_t i = 0; i < robot_.storage.size(); ++i)
    for (const CompartmentBox& box : robot_.storage[i].boxes())
      storage_.push_back(
          {add(box.size_m, Material::Storage, mask::kRobot), i, box.X_compartment_box});
  if (face)
    moving_.push_back({add({0.17, 0.115, 0.005}, Material::Magnets, mask::kGripper), 6,
                       robot_.X_flange_tool.pose() * Eigen::Translation3d(0, 0, -0.0025)});
}

/// Most of them lie still.
void RayScene::updateBricks(const SceneState& state) {
  for (std::size_t i = 0; i < std::min(bricks_.size(), state.bricks.size()); ++i) {
    if (state.bricks[i].matrix() == X_map_bricks_[i].matrix()) continue;
    X_map_bricks_[i] = state.bricks[i];
    rays_.setPose(bricks_[i], state.bricks[i]);
  }
  for (const StoragePart& part : storage_) {
    const double at = part.compartment < state.compartments_m.size()
                          ? state.compartments_m[part.compartment]
                          : 0.0;
    rays_.setPose(part.id, state.X_map_base *
                               robot_.storage[part.compartment].X_base_compartment(at) *
                               part.X_compartment_box);
  }
}

void RayScene::updateRobot(const SceneState& state) {
  const Eigen::Isometry3d X_map_armbase = state.X_map_base * robot_.X_base_armbase.pose();
  const auto frames = robot_.arm.frames(state.q);
  std::array<Eigen::Isometry3d, 7> X_map_link;
  X_map_link[0] = state.X_map_base;
  for (std::size_t i = 0; i < 6; ++i) X_map_link[i + 1] = X_map_armbase * frames[i];
  for (const Moving& part : moving_)
    rays_.setPose(part.id, X_map_link[static_cast<std::size_t>(part.link)] * part.X_link_shape);
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = i < 2 ? robot_.wheel_x_m : -robot_.wheel_x_m,
                 y = i % 2 == 0 ? robot_.wheel_y_m : -robot_.wheel_y_m;
    rays_.setPose(wheels_[i], state.X_map_base * Eigen::Translation3d(x, y, robot_.wheel_radius_m) *
                                  Eigen::AngleAxisd(state.steer_rad[i], Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX()));
  }
}

/// Strips of silk above and behind the plate, blown about: three incommensurate swings each.
void RayScene::updateFire(const SceneState& state) {
  const double t = toSeconds(state.stamp);
  for (std::size_t i = 0; i < flame_.size(); ++i) {
    const double phase = 1.7 * static_cast<double>(i);
    const double y = p_front_plate_.y() + (static_cast<double>(i) - 2.0) * 0.028 +
                     0.008 * std::sin(7.3 * t + phase);
    const double tilt = 0.25 * std::sin(5.1 * t + 2 * phase) + 0.15 * std::sin(11.7 * t + phase);
    const double height = 0.02 * std::sin(9.1 * t + phase);
    rays_.setPose(flame_[i], X_map_fire_ *
                                 Eigen::Translation3d(p_front_plate_.x() - 0.05, y, 0.06 + height) *
                                 Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()));
  }
  for (const Raycaster::Id id : burning_plate_) temperature_c_[id] = state.plate_c;
  for (const Raycaster::Id id : reflection_)
    temperature_c_[id] = fire_.ambient_c + reflection_ratio_ * (state.plate_c - fire_.ambient_c);
}

/// Only what the script needs: hidden shapes cost time too.
void RayScene::addDisturbances(const WorldConfig& config) {
  const auto scripted = [&](const char* fault) {
    return std::any_of(config.faults.begin(), config.faults.end(),
                       [&](const FaultConfig& f) { return f.name == fault; });
  };
  const auto person = number(Material::Person);
  for (std::size_t i = 0; i < kMaxPeople + 1 && (scripted("people") || scripted("person_in_way"));
       ++i) {
    people_.push_back({note(rays_.addCylinder(kPersonRadius, kPersonHeight - 2 * kPersonRadius,
                                              Eigen::Isometry3d::Identity(), person, 0),
                            kClothes_c),
                       note(rays_.addSphere(kPersonRadius, {0, 0, -5}, person, 0), kClothes_c),
                       note(rays_.addSphere(kPersonRadius, {0, 0, -5}, person, 0), kClothes_c)});
  }
  if (!scripted("view_blocked")) return;
  for (const double width : {2 * kBoardDistance, kBoardDistance, kBoardDistance}) {
    boards_.push_back(note(rays_.addBox({0.01, width, 0.5}, Eigen::Isometry3d::Identity(),
                                        number(Material::Obstacle), 0),
                           fire_.ambient_c));
  }
}

void RayScene::updateDisturbances(const SceneState& state) {
  if (moved_) rays_.setPose(boxes_[*moved_], X_map_boxes_[*moved_]);
  moved_.reset();
  if (state.moved) {
    moved_ = state.moved->box;
    rays_.setPose(boxes_[*moved_], state.moved->X_map_box);
  }
  const std::size_t shown = std::min(people_.size(), state.people.size());
  for (std::size_t i = 0; i < std::max(shown, people_shown_); ++i) {
    const Person& person = people_[i];
    for (const Raycaster::Id id : {person.body, person.hip, person.head})
      rays_.setMask(id, i < shown ? mask::kSolid : 0);
    if (i >= shown) continue;
    const auto at = [&](double z) {
      return Eigen::Isometry3d(Eigen::Translation3d(state.people[i] + Eigen::Vector3d(0, 0, z)));
    };
    rays_.setPose(person.body, at(0.5 * kPersonHeight));
    rays_.setPose(person.hip, at(kPersonRadius));
    rays_.setPose(person.head, at(kPersonHeight - kPersonRadius));
  }
  people_shown_ = shown;
  if (boards_.empty() || (!state.board_azimuth_rad && !boards_shown_)) return;
  boards_shown_ = state.board_azimuth_rad.has_value();
  for (const Raycaster::Id id : boards_) rays_.setMask(id, boards_shown_ ? mask::kBoard : 0);
  if (!boards_shown_) return;
  // Three sides of a rectangle open to the rear: half a turn.
  const Eigen::Isometry3d X = state.X_map_base * robot_.X_base_flange(state.q) * X_flange_lidar_ *
                              Eigen::AngleAxisd(*state.board_azimuth_rad, Eigen::Vector3d::UnitZ());
  rays_.setPose(boards_[0], X * Eigen::Translation3d(kBoardDistance, 0, 0));
  for (const double side : {1.0, -1.0}) {
    rays_.setPose(boards_[side > 0 ? 1 : 2],
                  X * Eigen::Translation3d(0.5 * kBoardDistance, side * kBoardDistance, 0) *
                      Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()));
  }
}

void RayScene::update(const SceneState& state) {
  updateRobot(state);
  updateFire(state);
  updateDisturbances(state);
  updateBricks(state);
  const std::size_t shown = std::min(drops_.size(), state.drops.size());
  for (std::size_t i = 0; i < std::max(shown, drops_shown_); ++i) {
    rays_.setMask(drops_[i], i < shown ? mask::kLightOnly : 0);
    if (i < shown)
      rays_.setPose(drops_[i], Eigen::Isometry3d(Eigen::Translation3d(state.drops[i])));
  }
  drops_shown_ = shown;
  if (state.obstacle || obstacle_shown_) {
    obstacle_shown_ = state.obstacle.has_value();
    rays_.setMask(obstacle_, obstacle_shown_ ? mask::kSolid : 0);
    if (obstacle_shown_)
      rays_.setPose(obstacle_, Eigen::Isometry3d(Eigen::Translation3d(*state.obstacle)));
  }
  rays_.commit();
}

}  // namespace kiln::sim
