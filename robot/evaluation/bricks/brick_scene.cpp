#include "robot/evaluation/bricks/brick_scene.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/scene/pile_layout.h"
#include "robot/scene/wall_layout.h"

namespace kiln {
namespace {

constexpr double kSizeError_m = 0.002;

double uniform(SceneRandom& random, double limit) {
  return std::uniform_real_distribution<double>(-limit, limit)(random);
}
double normal(SceneRandom& random, double sigma) {
  return std::normal_distribution<double>(0.0, sigma)(random);
}

Eigen::Vector3d drawnSize(BrickKind kind, SceneRandom& random) {
  Eigen::Vector3d size = brickSize(kind);
  for (int k = 0; k < 3; ++k) size[k] += uniform(random, kSizeError_m);
  return size;
}

/// Whether something of the scene lies on this brick.
bool carries(const BrickScene& scene, const TrueBrick& brick) {
  const Eigen::Vector3d& p = brick.X_world_brick.translation();
  return std::any_of(scene.bricks.begin(), scene.bricks.end(), [&](const TrueBrick& other) {
    const Eigen::Vector3d d = brick.X_world_brick.inverse() * other.X_world_brick.translation();
    const double reach = 0.5 * (brick.size_m.x() + other.size_m.x());
    return other.id != brick.id && other.X_world_brick.translation().z() > p.z() + 0.1 &&
           std::abs(d.x()) < reach && std::abs(d.y()) < kBrickSide_m;
  });
}

/// Leans the brick over one of its lower edges.
void tilt(TrueBrick& brick, SceneRandom& random) {
  const double angle = (8.0 + std::abs(uniform(random, 22.0))) * kDeg;
  const bool over_length = brick.kind == BrickKind::Red && uniform(random, 1.0) > 0.0;
  const double side = uniform(random, 1.0) > 0.0 ? 1.0 : -1.0;
  const int across = over_length ? 0 : 1;  // which way it leans, its own axis
  Eigen::Vector3d edge = -0.5 * brick.size_m.z() * Eigen::Vector3d::UnitZ();
  edge[across] = 0.5 * side * brick.size_m[across];
  // About the lower edge on that side, so that the other side rises.
  const Eigen::Vector3d axis = across == 0 ? Eigen::Vector3d(0, 1, 0) : Eigen::Vector3d(-1, 0, 0);
  brick.X_world_brick = brick.X_world_brick * Eigen::Translation3d(edge) *
                        Eigen::AngleAxisd(side * angle, axis) * Eigen::Translation3d(-edge);
  brick.fate = BrickFate::Tilted;
}

/// Lies on the ground beside what it fell from, clear of it, on the side of the robot.
void fall(TrueBrick& brick, const BrickScene& scene, SceneRandom& random) {
  const Eigen::Vector3d p = scene.X_world_target.inverse() * brick.X_world_brick.translation();
  const double yaw = uniform(random, M_PI), slide = uniform(random, 0.2);
  const double gap = kBrickSide_m + std::abs(uniform(random, 0.3));
  const double sin = std::abs(std::sin(yaw)), cos = std::abs(std::cos(yaw));
  // Half as deep as it lies, away from the line.
  const auto away = [&](double along, double across) {
    return gap + 0.5 * (along * brick.size_m.x() + across * brick.size_m.y());
  };
  const bool orange_leg = scene.wall && p.y() > 0.5;
  const Eigen::Vector2d at = orange_leg ? Eigen::Vector2d(p.x() - away(cos, sin), p.y() + slide)
                                        : Eigen::Vector2d(p.x() + slide, p.y() - away(sin, cos));
  brick.X_world_brick =
      scene.X_world_target * makePose({at.x(), at.y(), 0.5 * brick.size_m.z()}, {0, 0, yaw});
  brick.fate = BrickFate::Fallen;
}

}  // namespace

const TrueBrick* BrickScene::find(int id) const {
  for (const TrueBrick& brick : bricks)
    if (brick.id == id) return &brick;
  return nullptr;
}

BrickScene makePileScene(bool lab, SceneRandom& random) {
  const PileLayout layout = lab ? labPile() : arenaPile();
  BrickScene scene;
  scene.X_world_target =
      makePose({uniform(random, 5), uniform(random, 5), 0}, {0, 0, uniform(random, M_PI)});
  std::vector<Eigen::Vector3d> offset;
  for (std::size_t s = 0; s < layout.stacks.size(); ++s)
    offset.emplace_back(uniform(random, 0.05), uniform(random, 0.05), uniform(random, 10.0 * kDeg));
  double height = 0.0;
  for (const PileSlot& slot : layout.slots()) {
    TrueBrick brick;
    brick.id = static_cast<int>(scene.database.size());
    brick.kind = slot.kind;
    brick.size_m = drawnSize(slot.kind, random);
    if (slot.layer == 0) height = 0.0;
    const Eigen::Vector3d& nominal = slot.X_pile_brick.translation();
    const Eigen::Vector3d& o = offset[slot.stack];
    const double cos = std::cos(o.z()), sin = std::sin(o.z());
    const double dx = uniform(random, 0.01), dy = uniform(random, 0.01);  // on its stack
    brick.X_world_brick =
        scene.X_world_target *
        makePose({nominal.x() + o.x() + cos * dx - sin * dy,
                  nominal.y() + o.y() + sin * dx + cos * dy, height + 0.5 * brick.size_m.z()},
                 {0, 0, o.z() + uniform(random, 1.5 * kDeg)});
    height += brick.size_m.z();
    scene.bricks.push_back(brick);
    scene.database.push_back({brick.id, slot.kind, slot.X_pile_brick, false});
    scene.fates.push_back(BrickFate::InPlace);
  }
  return scene;
}

BrickScene makeWallScene(std::size_t bricks, SceneRandom& random) {
  Blueprint blueprint;
  for (std::size_t layer = 0; layer < kWallLayers; ++layer) {
    using enum BrickKind;
    std::vector<BrickKind> kinds{Red, Red, Red, Red, Green, Green, Blue};
    std::shuffle(kinds.begin(), kinds.end(), random);
    blueprint.layers.push_back(kinds);
  }
  std::vector<WallSlot> slots = wallSlots(blueprint);
  std::stable_sort(slots.begin(), slots.end(),
                   [](const WallSlot& a, const WallSlot& b) { return a.layer < b.layer; });
  slots.resize(std::min(slots.size(), bricks));
  BrickScene scene;
  scene.wall = true;
  scene.X_world_target =
      makePose({uniform(random, 5), uniform(random, 5), 0}, {0, 0, uniform(random, M_PI)});
  double wider = 0.0;  // what the joints of this layer and leg have added up to
  for (const WallSlot& slot : slots) {
    TrueBrick brick;
    brick.id = static_cast<int>(scene.database.size());
    brick.kind = slot.kind;
    brick.size_m = drawnSize(slot.kind, random);
    if (slot.index == 0) wider = 0.0;
    // The layers below are as high as bricks are on average; the error of sums is in the slots' own.
    const double up = 0.5 * (brick.size_m.z() - kBrickSide_m) + normal(random, 0.001);
    brick.X_world_brick =
        scene.X_world_target * slot.X_wall_brick *
        makePose({wider, normal(random, 0.004), up}, {0, 0, normal(random, 0.5 * kDeg)});
    wider += std::max(-0.001, normal(random, 0.003));
    scene.bricks.push_back(brick);
    scene.database.push_back({brick.id, slot.kind, slot.X_wall_brick, false});
    scene.fates.push_back(BrickFate::InPlace);
  }
  return scene;
}

void disturb(BrickScene& scene, double share, SceneRandom& random) {
  std::vector<int> loose;
  for (const TrueBrick& brick : scene.bricks)
    if (!carries(scene, brick)) loose.push_back(brick.id);
  std::shuffle(loose.begin(), loose.end(), random);
  loose.resize(std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(share * static_cast<double>(loose.size())))));
  std::uniform_int_distribution<int> pick(0, 2);
  for (const int id : loose) {
    const auto at = std::find_if(scene.bricks.begin(), scene.bricks.end(),
                                 [&](const TrueBrick& brick) { return brick.id == id; });
    const int what = pick(random);
    if (what == 1) fall(*at, scene, random);
    if (what == 2) tilt(*at, random);
    scene.fates[static_cast<std::size_t>(id)] = what == 0 ? BrickFate::Missing : at->fate;
    if (what == 0) scene.bricks.erase(at);
  }
}

}  // namespace kiln
