#include "robot/missions/wall/skills/view_planner.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>

#include "common/core/check.h"
#include "common/core/units.h"
#include "common/geom/pose.h"

namespace kiln {
namespace {

/// Beyond what is needed more cells are still worth a little: between two sweeps that cover the
/// same bricks the one that sees them better is taken.
constexpr double kMoreWorth = 0.1, kMoreTimes = 5.0;

/// One hypothesis where the target stands.
struct Hypothesis {
  Eigen::Isometry3d X_base_target;
  double weight = 1.0;
};

/// Sigma points of the unscented transform: the mean and both sides along each principal axis.
std::vector<Hypothesis> hypotheses(const ExpectedBricks& expected, double sigmas) {
  const Eigen::Isometry3d& X = expected.target.X_base_target;
  if (expected.covariance.isZero(0.0)) return {{X, 1.0}};
  const double side = 0.5 / (sigmas * sigmas);
  std::vector<Hypothesis> out{{X, 1.0 - 6.0 * side}};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(expected.covariance);
  for (int k = 0; k < 3; ++k) {
    const double sigma = std::sqrt(std::max(0.0, axes.eigenvalues()[k]));
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector3d d = sign * sigmas * sigma * axes.eigenvectors().col(k);
      Eigen::Isometry3d moved = X;
      moved.linear() = Eigen::AngleAxisd(d.z(), Eigen::Vector3d::UnitZ()) * X.linear();
      moved.translation() += Eigen::Vector3d(d.x(), d.y(), 0.0);
      out.push_back({moved, side});
    }
  }
  return out;
}

std::vector<ModelBrick> bricksAt(const BrickTarget& target,
                                 const Eigen::Isometry3d& X_base_target) {
  std::vector<ModelBrick> out;
  for (const TargetBrick& brick : target.bricks)
    out.push_back({brick.id, brick.kind, X_base_target * brick.X_target_brick});
  return out;
}

std::vector<Eigen::Vector3d> cornersOf(const BrickTarget& target,
                                       const std::vector<Hypothesis>& poses) {
  std::vector<Eigen::Vector3d> out;
  for (const Hypothesis& pose : poses)
    for (const TargetBrick& brick : target.bricks) {
      if (brick.excluded) continue;
      const Eigen::Vector3d half = 0.5 * brickSize(brick.kind);
      for (int k = 0; k < 8; ++k) {
        const Eigen::Vector3d p(k & 1 ? half.x() : -half.x(), k & 2 ? half.y() : -half.y(),
                                k & 4 ? half.z() : -half.z());
        out.push_back(pose.X_base_target * brick.X_target_brick * p);
      }
    }
  return out;
}

PlannedSweep turning(const LidarView& view, double duration_s, int instants) {
  PlannedSweep out{{}, duration_s};
  for (int k = 0; k < instants; ++k)
    out.X_world_lidar.push_back(
        view.X_base_lidar(view.tilt_from_rad + view.span() * k / (instants - 1)));
  return out;
}

}  // namespace

void ViewPlanner::Config::visit(ConfigArchive& a) {
  a.field("max_views", max_views, "", 1, 10, "sweeps from one place of the base");
  a.field("duration_s", duration_s, "s", 0.5, 30, "of the motion of one");
  a.field("margin_deg", margin_deg, "deg", 0, 20, "of tilt above and below the bricks");
  a.field("min_span_deg", min_span_deg, "deg", 1, 90, "of tilt");
  a.field("max_span_deg", max_span_deg, "deg", 1, 120, "of tilt");
  a.field("needed_cells", needed_cells, "", 0, 1e5, "found of a brick; 0: what perception needs");
  a.field("min_gain", min_gain, "", 0, 10, "of one brick; a sweep that adds less is not made");
  a.field("sigmas", sigmas, "", 1.7320508, 5, "of the poses that are tried");
  a.field("instants", instants, "", 2, 100, "of a motion, for the expectation");
  a.field("ahead_m", ahead_m, "m", -1, 1.5, "the fan's places, from the arm's mount on", false);
  a.field("aside_m", aside_m, "m", -1.5, 1.5, "and beside it", false);
  a.field("up_m", up_m, "m", -0.5, 1.5, "and above it", false);
  a.field("look_from_deg", look_from_deg, "deg", -60, 60, "tilt of the first look");
  a.field("look_to_deg", look_to_deg, "deg", -60, 60, "tilt of the first look");
  a.field("clearance_m", limits.clearance_m, "m", 0, 0.3, "of the arm on the way");
  a.field("speed_scale", limits.speed_scale, "", 0.01, 1, "of the joint limits");
  a.section("visibility", visibility, "what a sweep is expected to show");
}

ViewPlanner::ViewPlanner(const Config& config, const RobotGeometry& robot)
    : config_(config), robot_(robot) {}

double ViewPlanner::neededCells() const {
  return config_.needed_cells > 0.0 ? config_.needed_cells : cellsNeeded({});
}

std::vector<LidarView> ViewPlanner::fan(const ExpectedBricks& expected) const {
  const std::vector<Eigen::Vector3d> corners =
      cornersOf(expected.target, hypotheses(expected, config_.sigmas));
  if (corners.empty()) return {};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : corners) middle += p / static_cast<double>(corners.size());
  const Eigen::Vector3d mount = robot_.X_base_armbase.pose().translation();
  const double towards = std::atan2(middle.y() - mount.y(), middle.x() - mount.x());
  std::vector<LidarView> out;
  for (const double up : config_.up_m)
    for (const double ahead : config_.ahead_m)
      for (const double aside : config_.aside_m) {
        LidarView view;
        view.p_base = mount + Eigen::AngleAxisd(towards, Eigen::Vector3d::UnitZ()) *
                                  Eigen::Vector3d(ahead, aside, up);
        const Eigen::Vector3d d = middle - view.p_base;
        view.yaw_rad = std::atan2(d.y(), d.x());
        double low = 1e9, high = -1e9;  // downwards
        for (const Eigen::Vector3d& p : corners) {
          const Eigen::Vector3d c = p - view.p_base;
          const double tilt = std::atan2(-c.z(), c.head<2>().norm());
          low = std::min(low, tilt);
          high = std::max(high, tilt);
        }
        const double span = std::clamp(high - low + 2.0 * config_.margin_deg * kDeg,
                                       config_.min_span_deg * kDeg, config_.max_span_deg * kDeg);
        view.tilt_from_rad = 0.5 * (low + high - span);
        view.tilt_to_rad = view.tilt_from_rad + span;
        out.push_back(view);
      }
  return out;
}

/// What has been gathered so far, by hypothesis and piece of surface.
class ViewPlanner::Search {
 public:
  Search(const ViewPlanner& planner, const ExpectedBricks& expected)
      : config_(planner.config_),
        needed_(planner.neededCells()),
        target_(expected.target),
        poses_(hypotheses(expected, planner.config_.sigmas)) {
    for (const Hypothesis& pose : poses_) {
      models_.emplace_back(config_.visibility, bricksAt(target_, pose.X_base_target));
      gathered_.emplace_back(models_.back().pieces(), 0.0F);
    }
  }
  using Returns = std::vector<std::vector<float>>;  ///< by hypothesis

  [[nodiscard]] Returns expect(const PlannedSweep& sweep) {
    Returns out;
    for (SweepVisibility& model : models_) out.push_back(model.returnsOf(sweep));
    return out;
  }
  [[nodiscard]] Returns expect(const LidarView& view) {
    return expect(turning(view, config_.duration_s, config_.instants));
  }
  /// Cells of each brick, by expectation. @param with  more than what has been gathered
  [[nodiscard]] std::vector<double> cells(const Returns* with = nullptr) const {
    return cellsOf(gathered_, with);
  }
  [[nodiscard]] std::vector<double> cellsAlone(const Returns& of) const {
    return cellsOf(of, nullptr);
  }
  void add(const Returns& returns) {
    for (std::size_t h = 0; h < gathered_.size(); ++h)
      for (std::size_t i = 0; i < gathered_[h].size(); ++i) gathered_[h][i] += returns[h][i];
  }
  /// Wanted bricks that are found, in shares of what is needed of each.
  [[nodiscard]] double covered(const std::vector<double>& cells) const {
    double sum = 0.0;
    for (std::size_t b = 0; b < cells.size(); ++b)
      if (!target_.bricks[b].excluded) sum += std::min(1.0, cells[b] / needed_);
    return sum;
  }
  [[nodiscard]] double worth(const std::vector<double>& cells) const {
    double more = 0.0;
    for (std::size_t b = 0; b < cells.size(); ++b)
      if (!target_.bricks[b].excluded) more += std::min(1.0, cells[b] / (kMoreTimes * needed_));
    return covered(cells) + kMoreWorth * more;
  }
  [[nodiscard]] std::vector<std::size_t> uncovered(const std::vector<double>& cells) const {
    std::vector<std::size_t> out;
    for (std::size_t b = 0; b < cells.size(); ++b)
      if (!target_.bricks[b].excluded && cells[b] < needed_) out.push_back(b);
    return out;
  }

 private:
  [[nodiscard]] std::vector<double> cellsOf(const Returns& of, const Returns* with) const {
    std::vector<double> out(target_.bricks.size(), 0.0);
    for (std::size_t h = 0; h < of.size(); ++h) {
      std::vector<float> sum = of[h];
      if (with != nullptr)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += (*with)[h][i];
      const std::vector<double> found = models_[h].cellsFound(sum);
      for (std::size_t b = 0; b < out.size(); ++b) out[b] += poses_[h].weight * found[b];
    }
    return out;
  }

  const Config& config_;
  double needed_;
  const BrickTarget& target_;
  std::vector<Hypothesis> poses_;
  std::vector<SweepVisibility> models_;
  Returns gathered_;
};

Result<ViewPlan> ViewPlanner::plan(const ExpectedBricks& expected, const Reach& reach) const {
  if (!isFinite(expected.target.X_base_target) || !expected.covariance.allFinite())
    return makeError(ErrorCode::InvalidInput, "where the bricks are expected is not a number");
  std::vector<LidarView> open = fan(expected);
  if (open.empty())
    return makeError(ErrorCode::InvalidInput, "no brick is to be seen: all are excluded");
  Search search(*this, expected);
  std::vector<Search::Returns> returns;
  for (const LidarView& view : open) returns.push_back(search.expect(view));

  ViewPlan out;
  out.considered = static_cast<int>(open.size());
  out.cells = search.cells();
  while (static_cast<int>(out.views.size()) < config_.max_views &&
         !search.uncovered(out.cells).empty()) {
    const double covered = search.covered(out.cells);
    std::optional<std::size_t> best;
    double best_worth = 0.0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const std::vector<double> cells = search.cells(&returns[i]);
      const double worth = search.worth(cells);
      if (search.covered(cells) - covered < config_.min_gain || worth <= best_worth) continue;
      best = i;
      best_worth = worth;
    }
    if (!best) break;
    const LidarView view = open[*best];
    const auto motion = reach(view);
    if (motion) {
      // As the arm makes it, which is not quite as it was asked for.
      const Search::Returns real =
          search.expect({lidarPoses(robot_, *motion, config_.instants), motion->duration_s});
      out.views.push_back({view, *motion, search.cellsAlone(real)});
      search.add(real);
      out.cells = search.cells();
    } else {
      ++out.unreachable;
      out.why = motion.error().message;
    }
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(*best));
    returns.erase(returns.begin() + static_cast<std::ptrdiff_t>(*best));
  }
  out.uncovered = search.uncovered(out.cells);
  return out;
}

ViewPlan ViewPlanner::assess(const ExpectedBricks& expected,
                             const std::vector<LidarView>& views) const {
  Search search(*this, expected);
  ViewPlan out;
  out.considered = static_cast<int>(views.size());
  for (const LidarView& view : views) {
    const Search::Returns returns = search.expect(view);
    out.views.push_back({view, {}, search.cellsAlone(returns)});
    search.add(returns);
  }
  out.cells = search.cells();
  out.uncovered = search.uncovered(out.cells);
  return out;
}

Result<SweepMotion> ViewPlanner::firstLook(const Reach& reach) const {
  return reach(kiln::firstLook(robot_, config_.look_from_deg * kDeg, config_.look_to_deg * kDeg));
}

ViewPlanner::Reach ViewPlanner::reachOf(const ArmCollision& world, const Vector6d& q_near) const {
  return [this, &world, q_near](const LidarView& view) {
    return sweepMotion(robot_, world, view, q_near, config_.duration_s, config_.limits);
  };
}

}  // namespace kiln
