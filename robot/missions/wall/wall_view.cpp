#include "robot/missions/wall/wall_view.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "common/core/units.h"

namespace kiln::wall {
namespace {

constexpr const char* kPile = "wall.pile";
constexpr const char* kWall = "wall.blueprint";
constexpr const char* kCarried = "wall.carried";
constexpr double kGround_m = 0.02;

SceneItem brickItem(const char* layer, std::string id, const Eigen::Isometry3d& X_map_brick,
                    BrickKind kind, ItemStyle style, double width_px) {
  SceneItem item;
  item.id = std::move(id);
  item.layer = layer;
  item.shape = SceneItem::Shape::Box;
  item.style = style;
  item.width_px = width_px;
  item.X_map_item = X_map_brick;
  item.size = {brickShape(kind).length_m, kBrickSide_m, kBrickSide_m};
  return item;
}

/// Two standard deviations along the worst axis of the ground, and of the direction.
std::string spreadText(const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix2d C = covariance.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(C, Eigen::EigenvaluesOnly);
  return fmt::format("±{:.0f} cm, ±{:.1f}°",
                     200.0 * std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff())),
                     2.0 * std::sqrt(std::max(0.0, covariance(2, 2))) / kDeg);
}

SceneItem nameItem(const char* layer, const std::string& name, const Pose2& X_map_frame,
                   const std::optional<FoundFrame>& found) {
  SceneItem item;
  item.id = name;
  item.layer = layer;
  item.shape = SceneItem::Shape::Text;
  item.X_map_item = toIsometry(X_map_frame) * Eigen::Translation3d(0.0, 0.0, 1.3);
  item.label = name + (found ? " found" : ", as configured");
  if (found) item.detail = spreadText(found->covariance);
  return item;
}

/// The bricks as a look found them; how sure it is stands beside what is not trusted.
void addBricks(const WallContext& context, std::vector<SceneItem>& out) {
  int number = 0;
  for (const PileBrick& brick : context.belief.bricks) {
    ++number;
    if (brick.taken) continue;
    const bool trusted = brick.confidence > context.config.brick_look.trusted;
    out.push_back(brickItem(kPile, fmt::format("brick {}", number), brick.X_map_brick, brick.kind,
                            trusted ? ItemStyle::Sensed : ItemStyle::Configured,
                            trusted ? 1.6 : 1.0));
    if (!trusted)
      out.back().label =
          fmt::format("{}, {:.0f} %", toString(brick.state), 100.0 * brick.confidence);
  }
}

void addPile(const WallContext& context, std::vector<SceneItem>& out) {
  out.push_back(nameItem(kPile, "pile", context.X_map_pile(), context.belief.pile));
  if (!context.belief.bricks.empty()) return addBricks(context, out);
  const bool found = context.belief.pile.has_value();
  const Eigen::Isometry3d X_map_pile = toIsometry(context.X_map_pile());
  for (const PileSlot& slot : context.site.layout().slots())
    out.push_back(brickItem(kPile, fmt::format("stack {}", slot.stack + 1),
                            X_map_pile * slot.X_pile_brick, slot.kind,
                            found ? ItemStyle::Sensed : ItemStyle::Configured, 1.2));
}

/// The marker's L on the ground.
SceneItem markerItem(const WallContext& context) {
  const double l = kMarkerLength_m, w = kMarkerWidth_m;
  SceneItem item;
  item.id = "marker";
  item.layer = kWall;
  item.style = context.belief.wall ? ItemStyle::Sensed : ItemStyle::Configured;
  item.width_px = 2.0;
  const Eigen::Isometry3d X = toIsometry(context.X_map_wall());
  for (const auto& [x, y] :
       {std::pair{0.0, 0.0}, {l, 0.0}, {l, w}, {w, w}, {w, l}, {0.0, l}, {0.0, 0.0}})
    item.points.emplace_back(X * Eigen::Vector3d(x, y, kGround_m));
  return item;
}

void addWall(const WallContext& context, std::vector<SceneItem>& out) {
  out.push_back(markerItem(context));
  const Eigen::Isometry3d X_map_wall = toIsometry(context.X_map_wall());
  int number = 0;
  const std::vector<Eigen::Isometry3d>& built = context.belief.built;  // of the first load
  for (const WallLoad& load : context.plan.loads)
    for (const std::size_t index : load.slots) {
      const WallSlot& slot = context.plan.slots[index];
      const auto k = static_cast<std::size_t>(number);
      const bool set = k < built.size();
      const bool next = k == built.size() && context.loaded() && context.builds();
      out.push_back(brickItem(kWall, fmt::format("{}", ++number),
                              X_map_wall * (set ? built[k] : slot.X_wall_brick), slot.kind,
                              set    ? ItemStyle::Done
                              : next ? ItemStyle::Target
                                     : ItemStyle::Planned,
                              set || next ? 2.0 : 1.0));
      if (!set) out.back().label = fmt::format("{} {}", number, brickShape(slot.kind).letter);
    }
  out.push_back(nameItem(kWall, "wall", context.X_map_wall(), context.belief.wall));
}

/// What stands in the storage and what hangs on the gripper.
void addCarried(const WallContext& context, std::vector<SceneItem>& out) {
  const Eigen::Isometry3d X_map_base = toIsometry(context.parts.pose());
  for (const KnownBrick& brick : context.carriedBricks()) {
    const bool held = context.belief.held && brick.name == context.belief.held->name;
    out.push_back(brickItem(kCarried, fmt::format("{} {}", brick.name, out.size()),
                            X_map_base * brick.X_frame_brick, brick.kind,
                            held ? ItemStyle::Active : ItemStyle::Done, held ? 2.0 : 1.2));
  }
}

}  // namespace

MissionInfo missionInfo() {
  MissionInfo info;
  info.title = "Challenge 2, wall of bricks";
  FigureSpec bricks;
  bricks.id = "wall.bricks";
  bricks.label = "Bricks";
  bricks.decimals = 0;
  bricks.doc = "that the blueprint asks for";
  FigureSpec positions;
  positions.id = "wall.positions";
  positions.label = "Positions";
  positions.decimals = 0;
  positions.doc = "of the base before the wall, in the planned order";
  FigureSpec expected;
  expected.id = "wall.expected";
  expected.label = "Building takes";
  expected.unit = "min";
  expected.estimated = true;
  expected.doc = "at the wall, by the planner's model of arm and base";
  FigureSpec stored;
  stored.id = "wall.stored";
  stored.label = "In the storage";
  stored.decimals = 0;
  stored.doc = "bricks that the robot carries";
  FigureSpec set;
  set.id = "wall.set";
  set.label = "Set";
  set.decimals = 0;
  set.doc = "bricks that stand in the wall";
  info.figures = {bricks, stored, set, positions, expected};
  info.layers = {{kPile, "Pile"}, {kCarried, "Carried bricks"}, {kWall, "Wall"}};
  return info;
}

std::vector<Figure> figures(const WallContext& context) {
  const WallPlan& plan = context.plan;
  double positions = 0.0, expected_s = 0.0;
  for (const WallLoad& load : plan.loads) {
    positions += load.order.cost.positions;
    expected_s += load.expected_s;
  }
  return {{"wall.bricks", static_cast<double>(plan.slots.size())},
          {"wall.stored", static_cast<double>(context.belief.stored - context.belief.taken_out)},
          {"wall.set", static_cast<double>(context.belief.built.size())},
          {"wall.positions", positions},
          {"wall.expected", expected_s / 60.0}};
}

std::vector<SceneItem> sceneItems(const WallContext& context) {
  std::vector<SceneItem> out;
  addPile(context, out);
  addCarried(context, out);
  addWall(context, out);
  return out;
}

}  // namespace kiln::wall
