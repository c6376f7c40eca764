#include "robot/sim/wall_part.h"

#include <cmath>

#include "robot/sim/physics.h"
#include "robot/sim/world.h"

namespace kiln::sim {
namespace {

constexpr double kRest_s = 0.2;
constexpr double kDrop_m = 0.05;       ///< lower than where it lay or was let go
constexpr double kTiltCosine = 0.866;  ///< 30 deg from where it lay

}  // namespace

WallPart::WallPart(const TrueArena& arena, const RobotGeometry& robot)
    : arena_(arena), robot_(robot), watches_(arena.wall.bricks.size()) {
  for (const TrueBrick& brick : arena.wall.bricks) {
    BrickState state;
    state.X_map_brick = brick.X_map_brick;
    states_.push_back(state);
  }
}

std::optional<BinPlace> WallPart::binOf(const Eigen::Isometry3d& X_map_brick) const {
  for (std::size_t i = 0; i < robot_.storage.size() && i < compartments_m_.size(); ++i) {
    const CompartmentConfig& row = robot_.storage[i];
    const Eigen::Vector3d p = (X_map_base_ * row.X_base_compartment(compartments_m_[i])).inverse() *
                              X_map_brick.translation();
    if (p.x() < 0.0 || p.x() > row.bin_depth_m || p.z() < 0.0 || p.z() > 2.0) continue;
    const int bin = static_cast<int>(std::lround(p.y() / row.pitch() + 0.5 * (row.bins - 1)));
    if (bin < 0 || bin >= row.bins) continue;
    return BinPlace{i, bin};
  }
  return std::nullopt;
}

/// A fall is judged when it is over.
void WallPart::watch(std::size_t brick, double step_s) {
  Watch& w = watches_[brick];
  const BrickState& s = states_[brick];
  if (held_ == brick) {
    w.held = true;
    return;
  }
  if (w.held) {  // let go: from here on
    w.held = false;
    w.X_map_rest = s.X_map_brick;
    w.rest_s = 0.0;
  }
  w.rest_s = s.atRest() ? w.rest_s + step_s : 0.0;
  if (w.rest_s < kRest_s) return;
  if (binOf(s.X_map_brick)) {  // what is stored leans, and drives along
    w.X_map_rest.reset();
    return;
  }
  if (w.X_map_rest) {
    const bool lower = w.X_map_rest->translation().z() - s.X_map_brick.translation().z() > kDrop_m;
    const bool tilted =
        w.X_map_rest->linear().col(2).dot(s.X_map_brick.linear().col(2)) < kTiltCosine;
    if (lower || tilted) ++w.falls;
  }
  w.X_map_rest = s.X_map_brick;
}

void WallPart::step(Stamp, double step_s, const Physics& physics, SensorSuite&,
                    const SceneState& scene) {
  const BrickBodies* bricks = physics.bricks();
  X_map_base_ = scene.X_map_base;
  compartments_m_ = physics.compartmentPositions();
  if (bricks == nullptr) return;
  held_ = bricks->grip().held;
  for (std::size_t i = 0; i < bricks->size(); ++i) {
    if (states_[i].frozen && bricks->frozen(i)) continue;
    states_[i] = bricks->state(i);
    watch(i, step_s);
  }
}

void WallPart::show(SceneState& state, Stamp) const {
  state.compartments_m = compartments_m_;
  state.bricks.reserve(states_.size());
  for (const BrickState& s : states_) state.bricks.push_back(s.X_map_brick);
}

void WallPart::tell(Truth& truth) const {
  if (!arena_.wall.present()) return;
  WallTruth& t = truth.wall;
  t.X_map_pile = arena_.wall.X_map_pile;
  t.X_map_marker = arena_.wall.markerInMap();
  t.slots = arena_.wall.slots;
  std::vector<LyingBrick> lying;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const TrueBrick& brick = arena_.wall.bricks[i];
    BrickTruth b{brick.name, brick.kind, states_[i].X_map_brick, held_ == i, states_[i].atRest(),
                 {},         {},         watches_[i].falls};
    if (!b.held) b.stored = binOf(b.X_map_brick);
    t.falls += b.falls;
    t.bricks.push_back(b);
    if (b.held || b.stored || !b.at_rest) continue;
    lying.push_back({brick.kind, b.X_map_brick});
    index.push_back(i);
  }
  t.score = scoreWall(t.slots, lying, t.X_map_marker);
  for (std::size_t slot = 0; slot < t.score.brick_in_slot.size(); ++slot) {
    auto& brick = t.score.brick_in_slot[slot];
    if (!brick) continue;
    brick = index[*brick];
    t.bricks[*brick].slot = slot;
  }
  truth.score += t.score.points;
}

}  // namespace kiln::sim
