#include "robot/planning/arm_motion/arm_planner.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

/// Uniform in [0, 1), the same on every platform (std distributions are not).
double unit(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

constexpr double kSameTilt_rad = 0.05;

/// Axes 2, 3 and 4 of the arm are parallel and level: their sum and joint 6 are the flange's tilt.
double levelSum(const Vector6d& q) { return q[1] + q[2] + q[3]; }

bool sameTilt(const Vector6d& a, const Vector6d& b) {
  return std::abs(levelSum(a) - levelSum(b)) < kSameTilt_rad &&
         std::abs(a[5] - b[5]) < kSameTilt_rad;
}

}  // namespace

void ArmPlanner::Config::visit(ConfigArchive& a) {
  a.field("step_rad", step_rad, "rad", 0.02, 1, "longest tree edge");
  a.field("max_iterations", max_iterations, "", 10, 100000, "then the search gives up");
  a.field("shortcuts", shortcuts, "", 0, 10000, "attempts to straighten the path");
  a.field("seed", seed, "", 0, 1000000, "of the random samples");
}

ArmPlanner::ArmPlanner(const Config& config, const RobotGeometry& robot,
                       const ArmCollision& collision)
    : config_(config), limit_(robot.arm.position_limit), collision_(collision) {}

bool ArmPlanner::free(const Vector6d& a, const Vector6d& b) const {
  return collision_.pathIsFree(a, b, clearance_m_);
}

ArmPlanner::Progress ArmPlanner::start(const Vector6d& q_start, const std::vector<Vector6d>& goals,
                                       const ArmPathDemand& demand) {
  random_.seed(static_cast<std::uint32_t>(config_.seed));
  iterations_ = 0;
  grow_start_ = true;
  from_start_ = {{q_start, -1}};
  from_goal_.clear();
  path_.clear();
  // A start that is a little too near to something may leave, but not come nearer.
  clearance_m_ = std::min(demand.clearance_m.value_or(config_.clearance_m),
                          collision_.distance(q_start) - 1e-3);
  keep_tilt_ = demand.keep_tilt;
  if (clearance_m_ < 0.0 || goals.empty()) return Progress::Failed;
  low_ = (q_start.array() - M_PI).cwiseMax(-limit_.array());
  high_ = (q_start.array() + M_PI).cwiseMin(limit_.array());
  for (const Vector6d& goal : goals) {
    if (keep_tilt_ && !sameTilt(q_start, goal)) continue;
    low_ = low_.cwiseMin(goal);
    high_ = high_.cwiseMax(goal);
    from_goal_.push_back({goal, -1});
    if (free(q_start, goal)) {
      path_ = {q_start, goal};
      return Progress::Found;
    }
  }
  return from_goal_.empty() ? Progress::Failed : Progress::Running;
}

Vector6d ArmPlanner::sample() {
  Vector6d q;
  do {
    for (int i = 0; i < 6; ++i) q[i] = low_[i] + unit(random_) * (high_[i] - low_[i]);
    if (!keep_tilt_) return q;
    const Vector6d& start = from_start_.front().q;
    q[3] = levelSum(start) - q[1] - q[2];
    q[5] = start[5];
  } while (q[3] < low_[3] || q[3] > high_[3]);
  return q;
}

ArmPlanner::Grown ArmPlanner::extend(Tree& tree, const Vector6d& target) const {
  int nearest = 0;
  double best = INFINITY;
  for (std::size_t k = 0; k < tree.size(); ++k) {
    const double d = (tree[k].q - target).squaredNorm();
    if (d < best) {
      best = d;
      nearest = static_cast<int>(k);
    }
  }
  const Vector6d from = tree[static_cast<std::size_t>(nearest)].q;
  const double length = (target - from).cwiseAbs().maxCoeff();
  const bool last = length <= config_.step_rad;
  const Vector6d to =
      last ? target : Vector6d(from + (target - from) * (config_.step_rad / length));
  if (!free(from, to)) return Grown::Trapped;
  tree.push_back({to, nearest});
  return last ? Grown::Reached : Grown::Advanced;
}

ArmPlanner::Progress ArmPlanner::advance(int iterations) {
  for (int k = 0; k < iterations; ++k) {
    if (iterations_++ >= config_.max_iterations) return Progress::Failed;
    Tree& growing = grow_start_ ? from_start_ : from_goal_;
    Tree& other = grow_start_ ? from_goal_ : from_start_;
    grow_start_ = !grow_start_;
    if (extend(growing, sample()) == Grown::Trapped) continue;
    const Vector6d reached = growing.back().q;
    Grown grown = Grown::Advanced;
    while (grown == Grown::Advanced) grown = extend(other, reached);
    if (grown == Grown::Reached) {
      join();
      shorten();
      return Progress::Found;
    }
  }
  return Progress::Running;
}

void ArmPlanner::join() {
  path_.clear();
  for (int k = static_cast<int>(from_start_.size()) - 1; k >= 0;) {
    path_.push_back(from_start_[static_cast<std::size_t>(k)].q);
    k = from_start_[static_cast<std::size_t>(k)].parent;
  }
  std::reverse(path_.begin(), path_.end());
  // Both trees end at the same posture: take it once.
  int k = from_goal_.back().parent;
  while (k >= 0) {
    path_.push_back(from_goal_[static_cast<std::size_t>(k)].q);
    k = from_goal_[static_cast<std::size_t>(k)].parent;
  }
}

void ArmPlanner::shorten() {
  for (int attempt = 0; attempt < config_.shortcuts && path_.size() > 2; ++attempt) {
    // Two random points on the path, not only its corners.
    const double span = static_cast<double>(path_.size() - 1);
    double a = unit(random_) * span, b = unit(random_) * span;
    if (a > b) std::swap(a, b);
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    if (i == j) continue;
    const auto at = [&](double x, std::size_t n) {
      return Vector6d(path_[n] + (x - static_cast<double>(n)) * (path_[n + 1] - path_[n]));
    };
    const Vector6d qa = at(a, i), qb = at(b, j);
    if (!free(qa, qb)) continue;
    std::vector<Vector6d> shorter(path_.begin(),
                                  path_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    shorter.push_back(qa);
    shorter.push_back(qb);
    shorter.insert(shorter.end(), path_.begin() + static_cast<std::ptrdiff_t>(j) + 1, path_.end());
    path_ = std::move(shorter);
  }
  // Corners that a straight move makes superfluous.
  for (std::size_t k = 1; k + 1 < path_.size();) {
    if (free(path_[k - 1], path_[k + 1])) {
      path_.erase(path_.begin() + static_cast<std::ptrdiff_t>(k));
    } else {
      ++k;
    }
  }
}

}  // namespace kiln
