#include "robot/perception/bricks/brick_alignment.h"

#include <algorithm>
#include <cmath>

#include "common/core/check.h"
#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kStill_m = 3e-4, kStill_rad = 3e-4;  // a step this small ends a stage
constexpr double kReachSpare_m = 0.1;                 // a brick may move so far within a stage
constexpr double kOutlineFrom_m = 0.1;  // stages that are finer than it look for outlines
constexpr double kLowest_m = 0.05;  // a brick whose lower face starts below it stands on the ground

std::vector<Eigen::Vector3f> positions(const std::vector<SurfacePoint>& surface) {
  std::vector<Eigen::Vector3f> out;
  for (const SurfacePoint& point : surface) out.push_back(point.p);
  return out;
}

Eigen::Vector3d middleOf(const std::vector<ModelBrick>& bricks, const std::vector<bool>& free) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    if (!free[i]) continue;
    sum += bricks[i].X_world_brick.translation();
    count += 1.0;
  }
  return count > 0.0 ? Eigen::Vector3d(sum / count) : Eigen::Vector3d(1, 0, 0);
}

/// Do two bricks lie as neighbours or on each other? Asked in the frame of the first.
bool touch(const ModelBrick& a, const ModelBrick& b, double within_m) {
  const Eigen::Isometry3d X = a.X_world_brick.inverse() * b.X_world_brick;
  const Eigen::Vector3d half_b = 0.5 * X.linear().cwiseAbs() * brickSize(b.kind);
  const Eigen::Array3d gap =
      X.translation().array().abs() - (0.5 * brickSize(a.kind) + half_b).array();
  // Apart along one axis at most, and overlapping along the others.
  return gap.maxCoeff() < within_m && (gap < -within_m).count() >= 2;
}

}  // namespace

BrickAlignment::BrickAlignment(const BrickPoseEstimator::Config& config, const PreparedSweep& sweep,
                               ModelCloudGenerator& model, std::vector<ModelBrick> start,
                               std::vector<bool> free, const Clock* clock)
    : config_(config),
      sweep_(sweep),
      model_(model),
      clock_(clock),
      start_(std::move(start)),
      free_(std::move(free)),
      gone_(start_.size(), false),
      motions_(start_.size(), UprightMotion::Zero()),
      blocks_(start_.size()),
      outlines_(start_.size()),
      beams_(sweep.beams, sweep.p_level_sensor, middleOf(start_, free_)),
      tree_(positions(sweep.surface)) {
  KILN_CHECK(free_.size() == start_.size(), free_.size(), start_.size());
  findPairs();
  render();
}

double BrickAlignment::now() const { return clock_ != nullptr ? toSeconds(clock_->now()) : 0.0; }

ModelBrick BrickAlignment::brick(std::size_t i) const {
  ModelBrick out = start_[i];
  out.X_world_brick.linear() =
      Eigen::AngleAxisd(motions_[i][0], Eigen::Vector3d::UnitZ()) * out.X_world_brick.linear();
  out.X_world_brick.translation() += motions_[i].tail<3>();
  return out;
}

std::vector<ModelBrick> BrickAlignment::bricksThere() const {
  std::vector<ModelBrick> out;
  for (const std::size_t i : there_) out.push_back(brick(i));
  return out;
}

void BrickAlignment::findPairs() {
  pairs_.clear();
  for (std::size_t a = 0; a < size(); ++a)
    for (std::size_t b = a + 1; b < size(); ++b) {
      if (gone_[a] || gone_[b] || !free_[a] || !free_[b]) continue;
      if (!touch(start_[a], start_[b], config_.touch_m)) continue;
      PairBlock block;
      block.b_to_a = start_[a].X_world_brick.translation() - start_[b].X_world_brick.translation();
      block.stiffness = config_.stiffness;
      pairs_.push_back({a, b, block});
    }
}

void BrickAlignment::remove(std::span<const std::size_t> bricks) {
  for (const std::size_t i : bricks) {
    gone_[i] = true;
    blocks_[i].correspondences.clear();
    outlines_[i].clear();
  }
  findPairs();
  render();
}

void BrickAlignment::render() {
  there_.clear();
  ModelWorld world;
  world.sensors = {sweep_.p_level_sensor};
  for (std::size_t i = 0; i < size(); ++i) {
    if (gone_[i]) continue;
    there_.push_back(i);
    world.bricks.push_back(brick(i));
  }
  cloud_ = model_.generate(world);
}

std::array<FaceGrid, 6> BrickAlignment::lattice(std::size_t i) const {
  for (std::size_t k = 0; k < there_.size(); ++k)
    if (there_[k] == i) return cloud_.lattice[k];
  return {};
}

void BrickAlignment::addGround(std::size_t i, BrickBlock& block) const {
  const ModelBrick& brick = start_[i];
  const Eigen::Vector3d half = 0.5 * brickSize(brick.kind);
  if (brick.X_world_brick.translation().z() - half.z() > kLowest_m) return;
  for (int c = 0; c < 4; ++c) {
    const Eigen::Vector3d p =
        brick.X_world_brick * Eigen::Vector3d((c & 1) != 0 ? half.x() : -half.x(),
                                              (c & 2) != 0 ? half.y() : -half.y(), -half.z());
    block.correspondences.push_back(
        {p, {p.x(), p.y(), 0.0}, Eigen::Vector3d::UnitZ(), 0.25 * config_.ground_weight});
  }
}

/// An edge lies where it lies, wherever the brick is thought to be: asked once a stage.
void BrickAlignment::findOutlines() {
  for (const std::size_t i : there_) {
    outlines_[i].clear();
    if (!free_[i]) continue;
    const ModelBrick now = brick(i);
    const Eigen::Isometry3d X_start_now = start_[i].X_world_brick * now.X_world_brick.inverse();
    for (Correspondence c : outline(beams_, now, beams_.near(now, config_.gates.window_m),
                                    sweep_.p_level_sensor, config_.gates)) {
      c.p = X_start_now * c.p;
      c.weight = config_.outline_weight;
      outlines_[i].push_back(c);
    }
  }
}

void BrickAlignment::correspond(double distance_m) {
  const CorrespondenceGates gates{distance_m, config_.lateral_m, config_.min_cosine};
  const std::vector<ModelBrick> bricks = bricksThere();
  std::vector<std::vector<Correspondence>> found;
  if (config_.nearest_neighbours) {
    std::vector<ModelPoint> points = cloud_.points;
    // The cloud was rendered where the bricks lay at the last render().
    found = nearestNeighbours(sweep_, tree_, points, bricks.size(), gates);
  } else {
    found = assignment_->assign(bricks, cloud_.lattice, gates);
  }
  for (std::size_t k = 0; k < there_.size(); ++k) {
    const std::size_t i = there_[k];
    BrickBlock& block = blocks_[i];
    block.centre = start_[i].X_world_brick.translation();
    block.min_weight = config_.min_weight;
    block.hold = config_.hold;
    block.correspondences.clear();
    if (!free_[i]) continue;
    const Eigen::Isometry3d X_start_now =
        start_[i].X_world_brick * bricks[k].X_world_brick.inverse();
    // Every n-th of too many: they repeat each other, and the solve's time grows with them.
    const std::size_t stride =
        found[k].size() / static_cast<std::size_t>(config_.max_correspondences) + 1;
    for (std::size_t c = 0; c < found[k].size(); c += stride) {
      found[k][c].p = X_start_now * found[k][c].p;
      block.correspondences.push_back(found[k][c]);
    }
    block.correspondences.insert(block.correspondences.end(), outlines_[i].begin(),
                                 outlines_[i].end());
    addGround(i, block);
  }
}

void BrickAlignment::run(double from_m, int max_iterations) {
  for (const double distance : config_.distances_m) {
    if (distance > from_m) continue;
    if (iterations_ >= max_iterations) break;
    const double began = now();
    render();
    if (!config_.nearest_neighbours)
      assignment_.emplace(sweep_, bricksThere(), distance + kReachSpare_m);
    if (config_.use_outline && distance < kOutlineFrom_m) findOutlines();
    seconds_ += now() - began;
    const bool last = distance == config_.distances_m.back();
    const int stage = last ? max_iterations : static_cast<int>(max_iterations * 0.35);
    for (int k = 0; k < stage && iterations_ < max_iterations; ++k) {
      const double begin = now();
      if (config_.nearest_neighbours && k > 0) render();
      correspond(distance);
      const std::vector<UprightMotion> before = motions_;
      const double solving = now();
      (void)solveBricks(blocks_, pairs_, motions_, config_.solve);
      const double end = now();
      solve_seconds_ += end - solving;
      seconds_ += end - begin;
      ++iterations_;
      double turn = 0.0, shift = 0.0;
      for (std::size_t i = 0; i < size(); ++i) {
        turn = std::max(turn, std::abs(motions_[i][0] - before[i][0]));
        shift = std::max(shift, (motions_[i] - before[i]).tail<3>().norm());
      }
      if (turn < kStill_rad && shift < kStill_m) break;
    }
  }
}

SurfaceEvidence BrickAlignment::evidence(std::size_t i) const {
  const ModelBrick now = brick(i);
  return weigh(beams_, now, lattice(i), beams_.near(now, 0.02), config_.gates);
}

double BrickAlignment::foundByNeighbours(std::size_t i) const {
  int expected = 0, found = 0;
  for (const ModelPoint& point : cloud_.points) {
    if (point.brick == ModelPoint::kGround || there_[static_cast<std::size_t>(point.brick)] != i)
      continue;
    ++expected;
    const std::uint32_t at = tree_.nearest(point.p, static_cast<float>(config_.distances_m.back()));
    if (at != PointTree::kNone &&
        sweep_.surface[at].n.dot(point.n) > static_cast<float>(config_.min_cosine))
      ++found;
  }
  return expected > 0 ? static_cast<double>(found) / expected : 0.0;
}

std::vector<Eigen::Matrix4d> BrickAlignment::covariances() const {
  // The start is wrong for all bricks alike (rough pose): bricks that hold each other must not make
  // it surer by their number.
  const double together = std::sqrt(static_cast<double>(std::max<std::size_t>(1, there_.size())));
  const double turn = config_.touch_sigma_deg * kDeg,
               start_turn = together * config_.start_sigma_deg * kDeg,
               start = together * config_.start_sigma_m;
  return brickCovariances(
      blocks_, pairs_, motions_, config_.sigma_m,
      {turn, config_.touch_sigma_m, config_.touch_sigma_m, config_.touch_sigma_up_m},
      {start_turn, start, start, start});
}

std::vector<int> BrickAlignment::owners() const {
  std::vector<int> out(sweep_.surface.size(), -1);
  if (!assignment_) return out;
  const auto owned = assignment_->owners();
  for (std::size_t i = 0; i < out.size(); ++i)
    if (owned[i] >= 0) out[i] = static_cast<int>(there_[static_cast<std::size_t>(owned[i])]);
  return out;
}

}  // namespace kiln
