#include "robot/sim/walkers.h"

#include <cmath>

namespace kiln::sim {
namespace {

constexpr double kSpeed_mps = 1.1;
constexpr double kRadius_m = 0.35;        // with the arms
constexpr double kHead_m = 1.9;           // what hangs higher is no obstacle
constexpr double kRobotDistance_m = 1.7;  // half the robot's diagonal and half a metre
constexpr double kRest_s = 1.5;           // at a goal, at most
constexpr int kTries = 60;
// Before the building and in it.
const Eigen::AlignedBox2d kRange(Eigen::Vector2d(-2.0, -5.5), Eigen::Vector2d(13.5, 5.5));

}  // namespace

Walkers::Walkers(const TrueArena& arena, std::uint64_t seed, std::size_t count)
    : ground_(arena.ground) {
  const auto add = [this](const SolidBox& b) {
    if (!b.solid || b.X_map_box.translation().z() - 0.5 * b.size_m.z() > kHead_m) return;
    footprints_.push_back({b.X_map_box.inverse(), 0.5 * b.size_m.head<2>()});
  };
  for (const SolidBox& b : arena.boxes) add(b);
  for (const TrueFirePlace& place : arena.fire_places) {
    for (const SolidBox& b : place.boxes) add(b);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Walker walker{Random(seed, "walker " + std::to_string(i))};
    walker.p = walker.goal = drawPoint(walker.random);
    walkers_.push_back(std::move(walker));
  }
}

bool Walkers::free(const Eigen::Vector2d& p) const {
  if (!kRange.contains(p)) return false;
  for (const Footprint& f : footprints_) {
    const Eigen::Vector3d q = f.X_box_map * Eigen::Vector3d(p.x(), p.y(), 0.0);
    const Eigen::Vector2d out = (q.head<2>().cwiseAbs() - f.half).cwiseMax(0.0);
    if (out.norm() < kRadius_m) return false;
  }
  return true;
}

bool Walkers::freeLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const int steps = 1 + static_cast<int>((to - from).norm() / 0.1);
  for (int i = 1; i <= steps; ++i) {
    if (!free(from + (to - from) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

Eigen::Vector2d Walkers::drawPoint(Random& random) const {
  Eigen::Vector2d p = kRange.center();
  for (int i = 0; i < kTries; ++i) {
    p = {random.uniform(kRange.min().x(), kRange.max().x()),
         random.uniform(kRange.min().y(), kRange.max().y())};
    if (free(p)) break;
  }
  return p;
}

void Walkers::chooseGoal(Walker& walker) const {
  walker.rest_s = walker.random.uniform(0.0, kRest_s);
  for (int i = 0; i < kTries; ++i) {
    const Eigen::Vector2d goal = drawPoint(walker.random);
    if ((goal - walker.p).norm() < 1.0 || !freeLine(walker.p, goal)) continue;
    walker.goal = goal;
    return;
  }
}

void Walkers::move(Walker& w, double step_s, const Eigen::Vector2d& p_robot) const {
  const Eigen::Vector2d away = w.p - p_robot;
  const double distance = away.norm();
  Eigen::Vector2d next = w.p;
  if (distance < kRobotDistance_m) {
    // Steps aside; somebody with a wall behind squeezes past sideways.
    const Eigen::Vector2d out = away / std::max(1e-6, distance);
    for (const double turn : {0.0, 1.0, -1.0}) {
      next = w.p + kSpeed_mps * step_s * (Eigen::Rotation2Dd(turn) * out);
      if (free(next)) break;
      next = w.p;
    }
    w.p = w.goal = next;
    w.rest_s = 0.5;
    return;
  }
  if (w.rest_s > 0.0) {
    w.rest_s -= step_s;
    return;
  }
  const Eigen::Vector2d way = w.goal - w.p;
  const double stride = kSpeed_mps * step_s;
  next = way.norm() <= stride ? w.goal : Eigen::Vector2d(w.p + stride * way.normalized());
  if ((next - p_robot).norm() < kRobotDistance_m) {  // not past the robot: somewhere else, then
    w.goal = w.p;
    w.rest_s = 0.5;
    return;
  }
  w.p = next;
}

void Walkers::step(double step_s, const Eigen::Vector2d& p_robot) {
  for (Walker& walker : walkers_) {
    if (walker.p == walker.goal && walker.rest_s <= 0.0) chooseGoal(walker);
    move(walker, step_s, p_robot);
  }
}

std::vector<Eigen::Vector3d> Walkers::feet() const {
  std::vector<Eigen::Vector3d> out;
  for (const Walker& w : walkers_) out.emplace_back(w.p.x(), w.p.y(), ground_.height(w.p.x()));
  return out;
}

}  // namespace kiln::sim
