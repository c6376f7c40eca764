#include "robot/sim/true_wall.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/scene/blueprint.h"
#include "robot/sim/random.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {
namespace {

constexpr double kApart_m = 0.005;  ///< stacks as drawn leave at least that between them
constexpr int kTries = 2000;
constexpr double kSquare_m = 0.24, kSquarePitch_m = 0.42;  ///< yellow, on the marker
constexpr double kMarkerThick_m = 0.003, kPaint_m = 0.0002;
constexpr double kAerialGap_m = 0.15;

Pose2 jitter(Random& random, double m, double deg) {
  const double x = random.uniform(-m, m), y = random.uniform(-m, m);
  return {x, y, random.uniform(-deg, deg) * kDeg};
}

std::vector<Eigen::AlignedBox2d> drawPlates(const BrickShape& shape, double off_m, Random& random) {
  const Eigen::Vector2d half(0.5 * shape.plate_length_m, 0.5 * shape.plate_width_m);
  std::vector<Eigen::AlignedBox2d> out;
  for (int i = 0; i < shape.plates; ++i) {
    const double x = (i - 0.5 * (shape.plates - 1)) * shape.plate_length_m;
    const Eigen::Vector2d centre(x + random.uniform(-off_m, off_m), random.uniform(-off_m, off_m));
    out.emplace_back(centre - half, centre + half);
  }
  return out;
}

TrueBrick drawBrick(BrickKind kind, int number, const WallConfig& config, double size_m,
                    Random& random) {
  const BrickShape& shape = brickShape(kind);
  TrueBrick brick;
  brick.name = fmt::format("{} {}", shape.name, number);
  brick.kind = kind;
  brick.mass_kg = shape.mass_kg;
  brick.size_m = {shape.length_m, kBrickSide_m, kBrickSide_m};
  for (double& side : brick.size_m) side += random.uniform(-size_m, size_m);
  brick.plates = drawPlates(shape, config.plate_m, random);
  return brick;
}

/// A rectangle on the ground.
struct Footprint {
  Pose2 X;
  Eigen::Vector2d half;
};

/// Distance along the best of the four side axes; negative: they overlap.
double apart(const Footprint& a, const Footprint& b) {
  const Eigen::Vector2d between(b.X.x_m - a.X.x_m, b.X.y_m - a.X.y_m);
  double most = -1e9;
  for (const double yaw :
       {a.X.yaw_rad, a.X.yaw_rad + M_PI / 2, b.X.yaw_rad, b.X.yaw_rad + M_PI / 2}) {
    const Eigen::Vector2d axis(std::cos(yaw), std::sin(yaw));
    double reach = 0.0;
    for (const Footprint* f : {&a, &b}) {
      const Eigen::Vector2d along(std::cos(f->X.yaw_rad), std::sin(f->X.yaw_rad)),
          across(-along.y(), along.x());
      reach += f->half.x() * std::fabs(axis.dot(along)) + f->half.y() * std::fabs(axis.dot(across));
    }
    most = std::max(most, std::fabs(axis.dot(between)) - reach);
  }
  return most;
}

struct Stack {
  std::vector<TrueBrick> bricks;
  std::vector<Footprint> footprints;
};

/// Places the bricks of a stack about `X_map_stack`, from the ground up.
void place(Stack& stack, const Pose2& X_map_stack, const WallConfig& config, Random& random) {
  stack.footprints.clear();
  const Pose2 X = X_map_stack * jitter(random, config.stack_m, config.stack_deg);
  for (const TrueBrick& brick : stack.bricks)
    stack.footprints.push_back(
        {X * jitter(random, config.brick_m, config.brick_deg), 0.5 * brick.size_m.head<2>()});
}

bool clear(const Stack& stack, const std::vector<Stack>& others) {
  for (const Stack& other : others)
    for (std::size_t i = 0; i < std::min(stack.footprints.size(), other.footprints.size()); ++i)
      if (apart(stack.footprints[i], other.footprints[i]) < kApart_m) return false;
  return true;
}

Result<std::vector<Stack>> drawPile(const WallConfig& config, const WallSiteMap& site,
                                    const Pose2& X_map_pile, double size_m, std::uint64_t seed) {
  std::vector<Stack> stacks;
  std::array<int, kBrickKinds> count{};
  const PileLayout layout = site.layout();
  const std::vector<Eigen::Vector2d> middles = layout.middles();
  for (const PileStack& planned : layout.stacks) {
    const Eigen::Vector2d& middle = middles[stacks.size()];
    Random random(seed, "stack " + std::to_string(stacks.size()));
    Stack stack;
    for (int i = 0; i < planned.bricks; ++i)
      stack.bricks.push_back(drawBrick(
          planned.kind, ++count[static_cast<std::size_t>(planned.kind)], config, size_m, random));
    const Pose2 X = X_map_pile * Pose2{middle.x(), middle.y(), 0.0};
    int tries = 0;
    do place(stack, X, config, random);
    while (!clear(stack, stacks) && ++tries < kTries);
    if (tries == kTries)
      return makeError(
          ErrorCode::InvalidInput,
          "the stack of {} bricks at x = {:.1f} m of the pile finds no place beside its "
          "neighbours; take smaller errors or a larger stack_gap_m",
          brickShape(planned.kind).name, middle.x());
    stacks.push_back(std::move(stack));
  }
  return stacks;
}

Result<Blueprint> blueprint(const WallConfig& config, const WallSiteMap& site, std::uint64_t seed) {
  if (config.blueprint.empty()) return randomBlueprint(seed);
  const auto path = resourcePath(config.blueprint);
  if (!path) return tl::make_unexpected(path.error());
  auto read = loadBlueprint(*path);
  // The second leg is all orange: a pile without orange bricks is for a wall of one leg.
  if (read)
    read->orange_leg = std::any_of(site.stacks.begin(), site.stacks.end(), [](const auto& stack) {
      return stack.stack().kind == BrickKind::Orange;
    });
  return read;
}

}  // namespace

Eigen::Isometry3d TrueWall::markerInMap() const {
  return makePose({X_map_wall.x_m, X_map_wall.y_m, ground_z_m}, {0, 0, X_map_wall.yaw_rad});
}

Result<TrueWall> TrueWall::draw(const WallConfig& config, const WallSiteMap& site,
                                const GroundProfile& ground, double size_m, std::uint64_t seed) {
  TrueWall wall;
  if (site.stacks.empty()) return wall;
  Random random(seed, "wall site");
  // Turned about their own middles: the pile's ends stay within what is known of it.
  const Pose2 middle{0.5 * site.layout().length(), 0, 0};
  const auto displaced = [&](const Pose2& X, const Pose2& pivot) {
    const Pose2 error = jitter(random, config.site_m, config.site_deg);
    const Pose2 X_pivot = X * pivot;
    return Pose2{X_pivot.x_m + error.x_m, X_pivot.y_m + error.y_m,
                 X_pivot.yaw_rad + error.yaw_rad} *
           inverse(pivot);
  };
  wall.X_map_pile = displaced(site.pile.pose(), middle);
  wall.X_map_wall = displaced(site.marker.pose(), {0.5 * kMarkerLength_m, 0, 0});
  wall.ground_z_m = ground.height(wall.X_map_wall.x_m);
  auto stacks = drawPile(config, site, wall.X_map_pile, size_m, seed);
  if (!stacks) return tl::make_unexpected(stacks.error());
  for (Stack& stack : *stacks) {
    double z = ground.height(stack.footprints.front().X.x_m);
    for (std::size_t i = 0; i < stack.bricks.size(); ++i) {
      TrueBrick& brick = stack.bricks[i];
      const Pose2& X = stack.footprints[i].X;
      brick.X_map_brick = makePose({X.x_m, X.y_m, z + 0.5 * brick.size_m.z()}, {0, 0, X.yaw_rad});
      z += brick.size_m.z();
      wall.bricks.push_back(std::move(brick));
    }
  }
  auto drawing = blueprint(config, site, seed);
  if (!drawing) return tl::make_unexpected(drawing.error());
  wall.slots = wallSlots(*drawing);
  return wall;
}

std::vector<SolidBox> TrueWall::scenery(const WallConfig& config,
                                        const GroundProfile& ground) const {
  std::vector<SolidBox> out;
  if (!present()) return out;
  const auto flat = [&](const char* name, Material material, double x0, double y0, double x1,
                        double y1, double top) {
    SolidBox box;
    box.name = name;
    box.material = material;
    box.X_map_box =
        markerInMap() * Eigen::Translation3d(0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.5 * top);
    box.size_m = {x1 - x0, y1 - y0, top};
    box.solid = false;  // 3 mm: wheels do not notice
    out.push_back(box);
  };
  flat("marker", Material::MarkerMagenta, 0, 0, kMarkerLength_m, kMarkerWidth_m, kMarkerThick_m);
  flat("marker", Material::MarkerMagenta, 0, kMarkerWidth_m, kMarkerWidth_m, kMarkerLength_m,
       kMarkerThick_m);
  const double half = 0.5 * kSquare_m, mid = 0.5 * kMarkerWidth_m;
  for (double at = mid; at + half < kMarkerLength_m; at += kSquarePitch_m) {
    flat("marker square", Material::MarkerYellow, at - half, mid - half, at + half, mid + half,
         kMarkerThick_m + kPaint_m);
    if (at > kMarkerWidth_m)
      flat("marker square", Material::MarkerYellow, mid - half, at - half, mid + half, at + half,
           kMarkerThick_m + kPaint_m);
  }
  if (!config.aerial) return out;
  // The same bricks in one layer: each kind in rows of five, one behind the other.
  const Pose2 X_map_rows{config.aerial_x_m, config.aerial_y_m, config.aerial_deg * kDeg};
  double y = 0.0;
  for (const BrickShape& shape : kBrickShapes) {
    for (int i = 0; i < shape.count; ++i) {
      const int in_row = i % 5;
      if (i > 0 && in_row == 0) y += kBrickSide_m + kAerialGap_m;
      const Pose2 X =
          X_map_rows * Pose2{in_row * (shape.length_m + kAerialGap_m) + 0.5 * shape.length_m, y, 0};
      SolidBox box;
      box.name = fmt::format("aerial {} {}", shape.name, i + 1);
      box.material = brickMaterial(shape.kind);
      box.X_map_box =
          makePose({X.x_m, X.y_m, ground.height(X.x_m) + 0.5 * kBrickSide_m}, {0, 0, X.yaw_rad});
      box.size_m = {shape.length_m, kBrickSide_m, kBrickSide_m};
      out.push_back(box);
    }
    y += kBrickSide_m + kAerialGap_m;
  }
  return out;
}

}  // namespace kiln::sim
