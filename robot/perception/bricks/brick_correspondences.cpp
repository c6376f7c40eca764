#include "robot/perception/bricks/brick_correspondences.h"

#include <algorithm>
#include <cmath>

#include "robot/perception/bricks/point_tree.h"

namespace kiln {
namespace {

constexpr float kFullCount = 6.0F;  // returns in a leaf from which its weight is 1

bool visibleAround(const FaceGrid& grid, int i, int j) {
  for (int dj = -1; dj <= 1; ++dj)
    for (int di = -1; di <= 1; ++di) {
      const int x = i + di, y = j + dj;
      if (x < 0 || y < 0 || x >= grid.nu || y >= grid.nv) continue;
      if (grid.visible[grid.cell(x, y)] != 0) return true;
    }
  return false;
}

}  // namespace

SurfaceAssignment::SurfaceAssignment(const PreparedSweep& sweep, std::span<const ModelBrick> bricks,
                                     double reach_m)
    : sweep_(sweep),
      near_(bricks.size()),
      owners_(sweep.surface.size(), -1),
      matches_(sweep.surface.size()) {
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    const Eigen::Isometry3f X = bricks[b].X_world_brick.inverse().cast<float>();
    const Eigen::Array3f limit = (0.5 * brickSize(bricks[b].kind).array() + reach_m).cast<float>();
    for (std::size_t i = 0; i < sweep.surface.size(); ++i) {
      if (sweep.surface[i].n.isZero()) continue;
      const Eigen::Vector3f p = X * sweep.surface[i].p;
      if ((p.array().abs() < limit).all()) near_[b].push_back(static_cast<std::uint32_t>(i));
    }
  }
}

SurfaceAssignment::Match SurfaceAssignment::match(const SurfacePoint& point,
                                                  const Eigen::Isometry3f& X,
                                                  const Eigen::Vector3f& size,
                                                  const std::array<FaceGrid, 6>& lattice,
                                                  const CorrespondenceGates& gates) {
  const Eigen::Vector3f p = X * point.p, n = X.linear() * point.n;
  const Eigen::Vector3f over = p.cwiseAbs() - 0.5F * size;  // > 0: outside along this axis
  Match best;
  for (int k = 0; k < 3; ++k) {
    const int f = 2 * k + (p[k] > 0.0F ? 1 : 0);
    const float facing = p[k] > 0.0F ? n[k] : -n[k];
    if (facing < static_cast<float>(gates.min_cosine)) continue;
    const float off = std::abs(over[k]);
    if (off > static_cast<float>(gates.distance_m)) continue;
    const int u = k == 0 ? 1 : 0, v = k == 2 ? 1 : 2;
    const float beside = std::max({0.0F, over[u], over[v]});
    if (beside > static_cast<float>(gates.lateral_m)) continue;
    const float cost = off + 2.0F * beside;
    if (cost >= best.cost) continue;
    const FaceGrid& grid = lattice[static_cast<std::size_t>(f)];
    const auto cell = [&](int axis, int cells) {
      return std::clamp(static_cast<int>((p[axis] / size[axis] + 0.5F) * static_cast<float>(cells)),
                        0, cells - 1);
    };
    if (!visibleAround(grid, cell(u, grid.nu), cell(v, grid.nv))) continue;
    best = {cost, f};
  }
  return best;
}

std::vector<std::vector<Correspondence>> SurfaceAssignment::assign(
    std::span<const ModelBrick> bricks, std::span<const std::array<FaceGrid, 6>> lattice,
    const CorrespondenceGates& gates) {
  std::fill(owners_.begin(), owners_.end(), -1);
  std::fill(matches_.begin(), matches_.end(), Match{});
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    const Eigen::Isometry3f X = bricks[b].X_world_brick.inverse().cast<float>();
    const Eigen::Vector3f size = brickSize(bricks[b].kind).cast<float>();
    for (const std::uint32_t i : near_[b]) {
      const Match found = match(sweep_.surface[i], X, size, lattice[b], gates);
      if (found.cost >= matches_[i].cost) continue;
      matches_[i] = found;
      owners_[i] = static_cast<int>(b);
    }
  }
  std::vector<std::vector<Correspondence>> out(bricks.size());
  std::vector<Eigen::Isometry3d> inverse;
  for (const ModelBrick& brick : bricks) inverse.push_back(brick.X_world_brick.inverse());
  for (std::size_t i = 0; i < owners_.size(); ++i) {
    if (owners_[i] < 0) continue;
    const auto b = static_cast<std::size_t>(owners_[i]);
    const Eigen::Isometry3d& X = bricks[b].X_world_brick;
    const int k = matches_[i].face / 2;
    const double side = matches_[i].face % 2 == 0 ? -1.0 : 1.0;
    const Eigen::Vector3d q = sweep_.surface[i].p.cast<double>();
    Eigen::Vector3d p = inverse[b] * q;
    const double half = 0.5 * brickSize(bricks[b].kind)[k];
    const double off = (side * p[k] - half) / gates.distance_m;
    p[k] = side * half;
    const double inside = std::max(0.0, 1.0 - off * off), tukey = inside * inside;
    const double count = std::min(1.0F, sweep_.surface[i].count / kFullCount);
    out[b].push_back({X * p, q, X.linear().col(k) * side, tukey * count});
  }
  return out;
}

std::vector<std::vector<Correspondence>> nearestNeighbours(const PreparedSweep& sweep,
                                                           const PointTree& tree,
                                                           std::span<const ModelPoint> model,
                                                           std::size_t bricks,
                                                           const CorrespondenceGates& gates) {
  std::vector<std::vector<Correspondence>> out(bricks);
  for (const ModelPoint& point : model) {
    if (point.brick == ModelPoint::kGround) continue;
    const std::uint32_t i = tree.nearest(point.p, static_cast<float>(gates.distance_m));
    if (i == PointTree::kNone) continue;
    const SurfacePoint& q = sweep.surface[i];
    if (q.n.dot(point.n) < static_cast<float>(gates.min_cosine)) continue;
    out[static_cast<std::size_t>(point.brick)].push_back(
        {point.p.cast<double>(), q.p.cast<double>(), q.n.cast<double>(), 1.0});
  }
  return out;
}

}  // namespace kiln
