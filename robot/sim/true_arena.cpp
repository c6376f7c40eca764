#include "robot/sim/true_arena.h"

#include <cmath>
#include <optional>

#include "common/core/units.h"
#include "robot/sim/fault_catalog.h"
#include "robot/sim/random.h"
#include "robot/sim/true_ground.h"

namespace kiln::sim {
namespace {

Eigen::Vector3d vector3(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

Eigen::Vector3d perturbedSize(Eigen::Vector3d size, double limit_m, Random& random) {
  for (double& side : size) side = std::max(0.001, side + random.uniform(-limit_m, limit_m));
  return size;
}

Eigen::Isometry3d perturbedMount(const Eigen::Isometry3d& nominal, const PerturbationConfig& c,
                                 Random& random) {
  Eigen::Vector3d p, rpy;
  for (double& v : p) v = random.normal(c.extrinsic_m);
  for (double& v : rpy) v = random.normal(c.extrinsic_deg * kDeg);
  return nominal * makePose(p, rpy);
}

/// Frame bars along the twelve edges, acrylic panels between, and what physics has of the front
/// panel: boxes with a square hole. x runs from 0 (front) to -box.
void addFireBox(TrueFirePlace& place, const FireConfig& fire,
                const Eigen::Isometry3d& X_map_front) {
  place.frame_m = fire.frame_m;
  place.acrylic_m = fire.acrylic_thickness_m;
  place.rim_m = 0.6 * fire.frame_m;
  const double box = place.box_m, half = 0.5 * box, t = place.acrylic_m, f = place.frame_m;
  const auto add = [&](const char* what, Material m, Eigen::Vector3d lo, Eigen::Vector3d hi,
                       bool visible = true) {
    SolidBox b;
    b.name = place.name + " " + what;
    b.material = m;
    b.X_map_box = X_map_front * Eigen::Translation3d(0.5 * (lo + hi));
    b.size_m = hi - lo;
    b.visible = visible;
    b.temperature_c = fire.ambient_c;
    place.boxes.push_back(b);
  };
  for (const double s : {-1.0, 1.0}) {
    const double y0 = s < 0 ? -half : half - f, y1 = y0 + f;
    for (const double z : {-half, half - f})
      add("frame", Material::Frame, {-box, y0, z}, {0, y1, z + f});
    for (const double x : {-box, -f}) {
      add("frame", Material::Frame, {x, y0, -half + f}, {x + f, y1, half - f});
      add("frame", Material::Frame, {x, -half + f, y0}, {x + f, half - f, y1});
    }
    const double p0 = s < 0 ? -half : half - t, p1 = p0 + t;
    add("side", Material::Acrylic, {-box + f, p0, -half + f}, {-f, p1, half - f});
    add("lid", Material::Acrylic, {-box + f, -half + f, p0}, {-f, half - f, p1});
  }
  add("back", Material::Acrylic, {-box, -half + f, -half + f}, {-box + t, half - f, half - f});
  const double o = 0.5 * place.opening_m, e = half - f;
  for (const double s : {-1.0, 1.0}) {
    const double a0 = s < 0 ? -e : o, a1 = s < 0 ? -o : e;
    add("front", Material::Acrylic, {-t, a0, -e}, {0, a1, e}, false);
    add("front", Material::Acrylic, {-t, -o, a0}, {0, o, a1}, false);
  }
}

/// Any horizontal one.
Eigen::Vector3d direction(std::uint64_t seed, const std::string& of) {
  const double angle = Random(seed, "misplaced " + of).uniform(-M_PI, M_PI);
  return {std::cos(angle), std::sin(angle), 0};
}

/// @param misplaced_m stands so far from its configured place, instead of within the tolerance.
TrueFirePlace drawFirePlace(const WorldConfig& config, const FireSiteMap& nominal,
                            const FirePlaceConfig& spot, std::optional<double> misplaced_m,
                            std::uint64_t seed) {
  Random random(seed, "fire place " + spot.name);
  const PerturbationConfig& c = config.perturbation;
  TrueFirePlace place;
  place.name = spot.name;
  place.opening_m = nominal.opening_m;
  place.plate_m = nominal.plate_m;
  place.box_m = nominal.box_size_m + random.uniform(-c.size_m, c.size_m);
  Eigen::Vector3d shift(random.uniform(-c.fire_box_m, c.fire_box_m),
                        random.uniform(-c.fire_box_m, c.fire_box_m), 0);
  if (misplaced_m) shift = *misplaced_m * direction(seed, spot.name);
  const double yaw = (spot.facing_deg + random.uniform(-c.fire_box_deg, c.fire_box_deg)) * kDeg;
  const double table_h = nominal.table_height_m + random.uniform(-c.size_m, c.size_m);
  Eigen::Vector3d plate = vector3(spot.plate_xyz_m) + shift;
  plate.z() += table_h - nominal.table_height_m + 0.5 * (place.box_m - nominal.box_size_m);
  // The box is turned about the nominal plate centre.
  place.X_map_front = makePose(plate, {0, 0, yaw}) * Eigen::Translation3d(nominal.recess_m, 0, 0);
  place.p_front_plate = {-nominal.recess_m,
                         random.uniform(-c.plate_off_centre_m, c.plate_off_centre_m),
                         random.uniform(-c.plate_off_centre_m, c.plate_off_centre_m)};
  const double hottest = random.uniform(config.fire.reflection_min_c, config.fire.reflection_max_c);
  place.reflection_ratio = (hottest - config.fire.ambient_c) / config.fire.rise_k;
  addFireBox(place, config.fire, place.X_map_front);
  SolidBox table{spot.name + " table", Material::Table,
                 place.X_map_front * Eigen::Translation3d(0.05 - 0.5 * nominal.table_size_m, 0,
                                                          -0.5 * place.box_m - 0.5 * table_h),
                 perturbedSize({nominal.table_size_m, nominal.table_size_m, 0}, c.size_m, random)};
  table.size_m.z() = table_h;
  place.boxes.push_back(table);
  return place;
}

std::optional<double> misplacement(const WorldConfig& config, std::size_t place,
                                   std::size_t burning) {
  for (const FaultConfig& fault : config.faults) {
    if (fault.name != "fire_box_misplaced") continue;
    const double wanted = faultValue(fault, 1);  // 0: the burning one, else counted from 1
    if (wanted == 0.0 ? place == burning : static_cast<double>(place + 1) == wanted)
      return faultValue(fault, 0);
  }
  return std::nullopt;
}

TrueRobot drawRobot(const WorldConfig& config, const RobotGeometry& robot, std::uint64_t seed) {
  Random random(seed, "robot");
  TrueRobot out;
  for (std::size_t i = 0; i < 4; ++i) {
    out.wheel_radius_error[i] = random.normal(config.base.wheel_radius_sigma);
    out.steer_offset_rad[i] = random.normal(config.base.steer_offset_sigma_deg * kDeg);
  }
  out.X_flange_lidar = perturbedMount(robot.X_flange_lidar.pose(), config.perturbation, random);
  out.X_flange_thermal = perturbedMount(robot.X_flange_thermal.pose(), config.perturbation, random);
  out.X_flange_nozzle = perturbedMount(robot.X_flange_nozzle.pose(), config.perturbation, random);
  out.X_base_operatorcamera =
      perturbedMount(robot.X_base_operatorcamera.pose(), config.perturbation, random);
  Random camera(seed, "head camera");
  out.X_flange_rgb = perturbedMount(robot.X_flange_rgb.pose(), config.perturbation, camera);
  Random head(seed, "head");
  out.head_kg = config.arm.head_kg + head.uniform(-config.arm.head_off_kg, config.arm.head_off_kg);
  for (double& v : out.p_flange_head)
    v += head.uniform(-config.arm.head_off_m, config.arm.head_off_m);
  return out;
}

Eigen::Vector3d drawSun(const SunConfig& config, std::uint64_t seed) {
  Random random(seed, "sun");
  const double azimuth = random.uniform(-M_PI, M_PI);
  const double up = random.uniform(config.min_elevation_deg, config.max_elevation_deg) * kDeg;
  return {std::cos(up) * std::cos(azimuth), std::cos(up) * std::sin(azimuth), std::sin(up)};
}

}  // namespace

Result<void> TrueArena::addWall(const WorldConfig& config, const WallSiteMap& site,
                                std::uint64_t seed) {
  auto drawn = TrueWall::draw(config.wall, site, ground, config.perturbation.size_m, seed);
  if (!drawn) return tl::make_unexpected(drawn.error());
  wall = std::move(*drawn);
  if (!wall.present()) return {};
  for (SolidBox& box : ground_boxes) box.material = Material::Ground;
  for (SolidBox& box : wall.scenery(config.wall, ground)) {
    box.temperature_c = config.fire.ambient_c;
    boxes.push_back(std::move(box));
  }
  return {};
}

TrueArena TrueArena::draw(const WorldConfig& config, const ArenaMap& nominal,
                          const FireSiteMap& site, const RobotGeometry& robot, std::uint64_t seed) {
  TrueArena arena;
  Random random(seed, "arena");
  const PerturbationConfig& c = config.perturbation;
  for (const BoxConfig& wall : nominal.walls) {
    arena.boxes.push_back({wall.name, Material::Wall, wall.center.pose(),
                           perturbedSize(vector3(wall.size_m), c.size_m, random)});
  }
  for (const BoxConfig& item : nominal.furniture) {
    Eigen::Isometry3d X = item.center.pose();
    X.pretranslate(Eigen::Vector3d(random.uniform(-c.furniture_m, c.furniture_m),
                                   random.uniform(-c.furniture_m, c.furniture_m), 0));
    arena.boxes.push_back(
        {item.name, Material::Furniture, X, perturbedSize(vector3(item.size_m), c.size_m, random)});
  }
  for (const DistractorConfig& d : config.distractors) {
    arena.boxes.push_back({d.name, d.solid ? Material::WarmBody : Material::WarmPatch,
                           d.center.pose(), vector3(d.size_m), d.solid,
                           random.uniform(d.min_c, d.max_c)});
  }
  for (const WarmBoardConfig& board : config.warm_boards) {
    for (SolidBox& box : arena.boxes) {
      if (box.name == board.box)
        box.temperature_c =
            Random(seed, "warm board " + board.box).uniform(board.min_c, board.max_c);
    }
  }
  if (!site.places.empty()) arena.burning = Random(seed, "burning").bits() % site.places.size();
  for (std::size_t i = 0; i < site.places.size(); ++i) {
    arena.fire_places.push_back(
        drawFirePlace(config, site, site.places[i], misplacement(config, i, arena.burning), seed));
    arena.fire_places.back().burning = i == arena.burning;
  }
  arena.ground = drawGround(config, nominal, seed);
  arena.ground_boxes = groundBoxes(arena.ground, config.fire.ambient_c);
  if (config.sun.drawn) arena.to_sun = drawSun(config.sun, seed);
  arena.robot = drawRobot(config, robot, seed);
  arena.nominal_start = nominal.start.pose();
  return arena;
}

std::vector<Eigen::AlignedBox2d> TrueArena::reducedZones(double around_m) const {
  Eigen::AlignedBox2d building, pile, marker;
  const auto extend = [](Eigen::AlignedBox2d& zone, const Eigen::Isometry3d& X,
                         const Eigen::Vector3d& size) {
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        zone.extend((X * size.cwiseProduct(Eigen::Vector3d(x, y, 0))).head<2>());
  };
  for (const SolidBox& b : boxes) {
    if (b.material == Material::Wall) extend(building, b.X_map_box, b.size_m);
    if (b.material == Material::MarkerMagenta) extend(marker, b.X_map_box, b.size_m);
  }
  for (const TrueBrick& brick : wall.bricks) extend(pile, brick.X_map_brick, brick.size_m);
  std::vector<Eigen::AlignedBox2d> out;
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(around_m);
  for (const Eigen::AlignedBox2d& zone : {building, pile, marker})
    if (!zone.isEmpty()) out.emplace_back(zone.min() - around, zone.max() + around);
  return out;
}

Pose2 drawStart(const PerturbationConfig& config, const Pose2& nominal, std::uint64_t seed,
                std::uint32_t count) {
  Random random(seed, "start " + std::to_string(count));
  Pose2 error;
  error.x_m = random.uniform(-config.start_m, config.start_m);
  error.y_m = random.uniform(-config.start_m, config.start_m);
  error.yaw_rad = random.uniform(-config.start_deg, config.start_deg) * kDeg;
  return {nominal.x_m + error.x_m, nominal.y_m + error.y_m, nominal.yaw_rad + error.yaw_rad};
}

}  // namespace kiln::sim
