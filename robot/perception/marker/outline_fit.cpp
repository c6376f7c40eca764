#include "robot/perception/marker/outline_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Dense>
#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include "robot/perception/marker/marker_shape.h"

namespace kiln::marker {
namespace {

// x, y, yaw of the wall in odom; turn of the camera about its axes; correction of the ground's
// plane in the level frame; offset of the masks' edge, px.
constexpr int kUnknowns = 10;
using Unknowns = std::array<double, kUnknowns>;

/// Where a ray meets the corrected ground, in odom. Negative range: nowhere.
template <class T>
Eigen::Matrix<T, 2, 1> meetGround(const PictureFrame& frame, const Eigen::Vector3d& direction,
                                  const T* turn, const T* ground, T& range) {
  const Eigen::Matrix<T, 3, 1> d = direction.cast<T>();
  Eigen::Matrix<T, 3, 1> turned;
  ceres::AngleAxisRotatePoint(turn, d.data(), turned.data());
  const Eigen::Matrix<T, 3, 1> ray = frame.X_level_rgb.linear().cast<T>() * turned;
  const Eigen::Vector3d& o = frame.X_level_rgb.translation();
  const T above = o.z() - (frame.ground_m + ground[0] + ground[1] * o.x() + ground[2] * o.y());
  range = above / -(ray.z() - ground[1] * ray.x() - ground[2] * ray.y());
  const T x = o.x() + range * ray.x(), y = o.y() + range * ray.y();
  const double c = std::cos(frame.X_odom_level.yaw_rad), s = std::sin(frame.X_odom_level.yaw_rad);
  return {c * x - s * y + frame.X_odom_level.x_m, s * x + c * y + frame.X_odom_level.y_m};
}

template <class T>
Eigen::Matrix<T, 2, 1> intoWall(const Eigen::Matrix<T, 2, 1>& p_odom, const T* wall) {
  const T c = ceres::cos(wall[2]), s = ceres::sin(wall[2]);
  const T x = p_odom.x() - wall[0], y = p_odom.y() - wall[1];
  return {c * x + s * y, c * y - s * x};
}

/// One point of the outline and the side of the marker that it lies on.
struct OnSide {
  const PictureFrame* frame;
  Eigen::Vector3d direction;
  Side side;
  double metres_per_px;  ///< along the side's normal
  double sigma_m;

  template <class T>
  T distance(const T* x) const {
    T range;
    const Eigen::Matrix<T, 2, 1> p =
        intoWall(meetGround(*frame, direction, x + 3, x + 6, range), x);
    const T out =
        side.outward.x() * (p.x() - side.from.x()) + side.outward.y() * (p.y() - side.from.y());
    return (out - x[9] * metres_per_px) / sigma_m;
  }
  template <class T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = distance(x);
    return true;
  }
};

struct Known {
  double camera_rad, offset_px;
  Eigen::Matrix3d ground_root;  ///< R with Rᵀ R = inverse covariance

  template <class T>
  bool operator()(const T* x, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = x[3 + i] / camera_rad;
    const Eigen::Matrix<T, 3, 1> g =
        ground_root.cast<T>() * Eigen::Map<const Eigen::Matrix<T, 3, 1>>(x + 6);
    for (int i = 0; i < 3; ++i) residual[3 + i] = g[i];
    residual[6] = x[9] / offset_px;
    return true;
  }
};

/// Distance to a side with its ends, metres.
double away(const Side& side, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = side.to - side.from;
  const double t = std::clamp((p - side.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - side.from - t * along).norm();
}

/// The side of the marker that a seen point belongs to.
std::optional<OnSide> assign(const PictureFrame& frame, const SeenOutline& seen, const double* x,
                             const OutlineFitConfig& config) {
  const auto onWall = [&](const Eigen::Vector2d& shift_px) {
    Eigen::Vector3d d = seen.direction_rgb;
    d.head<2>() += shift_px / seen.focal_px;
    double range = 0.0;
    const Eigen::Vector2d p = intoWall<double>(meetGround(frame, d, x + 3, x + 6, range), x);
    return std::make_pair(p, range > 0.0 && std::isfinite(range));
  };
  const auto [p, met] = onWall(Eigen::Vector2d::Zero());
  const auto [outside, met_outside] = onWall(seen.outward);
  const auto [beside, met_beside] = onWall(Eigen::Vector2d(-seen.outward.y(), seen.outward.x()));
  if (!met || !met_outside || !met_beside) return std::nullopt;
  const Eigen::Vector2d along = beside - p, step = outside - p;
  Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
  if (normal.dot(step) < 0.0) normal = -normal;
  constexpr double kSameWay = 0.5;
  const Side* best = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Side& side : sides()) {
    if (side.outward.dot(normal) < kSameWay) continue;
    const double distance = away(side, p);
    if (distance < nearest) {
      nearest = distance;
      best = &side;
    }
  }
  if (best == nullptr) return std::nullopt;
  const double scale = std::abs(best->outward.dot(step));
  return OnSide{&frame, seen.direction_rgb, *best, scale,
                std::hypot(config.sigma_px * scale, frame.drift_m)};
}

struct Solver {
  std::span<const PictureFrame> frames;
  std::vector<SeenOutline> outline;
  const OutlineFitConfig& config;
  Known known;
  Unknowns x{};

  [[nodiscard]] std::vector<OnSide> select(double gate_m, double gate_sigma) const {
    std::vector<OnSide> out;
    for (const SeenOutline& seen : outline) {
      const auto on = assign(frames[seen.frame], seen, x.data(), config);
      if (!on) continue;
      const double off = std::abs(on->distance(x.data()));
      if (off <= gate_sigma || off * on->sigma_m <= gate_m) out.push_back(*on);
    }
    return out;
  }

  void build(ceres::Problem& problem, const std::vector<OnSide>& used) {
    const double worth =
        std::min(1.0, config.independent_points / static_cast<double>(used.size()));
    auto* loss = new ceres::ScaledLoss(new ceres::CauchyLoss(2.0), worth, ceres::TAKE_OWNERSHIP);
    for (const OnSide& on : used)
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<OnSide, 1, kUnknowns>(new OnSide(on)), loss, x.data());
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Known, 7, kUnknowns>(new Known(known)),
                             nullptr, x.data());
  }

  bool solve(ceres::Problem& problem) const {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 15;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary.IsSolutionUsable();
  }
};

Eigen::Matrix3d poseCovariance(ceres::Problem& problem, const double* x, bool& ok) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  Eigen::Matrix<double, kUnknowns, kUnknowns, Eigen::RowMajor> all;
  const std::vector<std::pair<const double*, const double*>> blocks{{x, x}};
  ok = covariance.Compute(blocks, &problem) && covariance.GetCovarianceBlock(x, x, all.data());
  if (!ok) return Eigen::Matrix3d::Zero();
  return all.topLeftCorner<3, 3>();
}

}  // namespace

void OutlineFitConfig::visit(ConfigArchive& a) {
  a.field("sigma_px", sigma_px, "px", 0.05, 20, "of a point of the outline, one sigma");
  a.field("offset_sigma_px", offset_sigma_px, "px", 0.01, 20, "of the masks' edge, common to all");
  a.field("max_points", max_points, "", 50, 100000, "of the outline that are used");
  a.field("independent_points", independent_points, "", 10, 100000,
          "as many the points are worth: neighbours err together");
  a.field("first_gate_m", first_gate_m, "m", 0.05, 5, "in the first round");
  a.field("last_gate_sigma", last_gate_sigma, "", 1, 20, "in the last round");
  a.field("rounds", rounds, "", 1, 30, "of assigning and fitting, the gate halved each time");
}

Eigen::Vector2d PictureFrame::onGround(const Eigen::Vector3d& direction_rgb) const {
  return OutlineFit().onGround(*this, direction_rgb);
}

Eigen::Vector2d OutlineFit::onGround(const PictureFrame& frame,
                                     const Eigen::Vector3d& direction_rgb) const {
  double range = 0.0;
  const Eigen::Vector2d p =
      meetGround(frame, direction_rgb, camera_turn.data(), ground.data(), range);
  if (!(range > 0.0)) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return p;
}

OutlineFit fitOutline(std::span<const PictureFrame> frames, std::span<const SeenOutline> outline,
                      const Pose2& start, const OutlinePrior& prior,
                      const OutlineFitConfig& config) {
  OutlineFit out;
  out.X_odom_wall = start;
  Solver solver{frames, {}, config, {}, {}};
  const std::size_t stride =
      outline.size() / static_cast<std::size_t>(std::max(1, config.max_points)) + 1;
  for (std::size_t i = 0; i < outline.size(); i += stride) solver.outline.push_back(outline[i]);
  const Eigen::LLT<Eigen::Matrix3d> information(prior.ground.inverse());
  if (information.info() != Eigen::Success) return out;
  solver.known = {prior.camera_rad, config.offset_sigma_px, information.matrixU()};
  solver.x = {start.x_m, start.y_m, start.yaw_rad};
  constexpr std::size_t kLeast = 20;
  for (int round = 0; round < config.rounds; ++round) {
    const double gate_m = config.first_gate_m * std::pow(0.5, round);
    const auto used = solver.select(gate_m, config.last_gate_sigma);
    if (used.size() < kLeast) return out;
    ceres::Problem problem;
    solver.build(problem, used);
    if (!solver.solve(problem)) return out;
  }
  const auto used = solver.select(0.0, config.last_gate_sigma);
  if (used.size() < kLeast) return out;
  ceres::Problem problem;
  solver.build(problem, used);
  if (!solver.solve(problem)) return out;
  out.covariance = poseCovariance(problem, solver.x.data(), out.converged);
  double squares = 0.0;
  for (const OnSide& on : used) {
    const double off = on.distance(solver.x.data());
    squares += off * off;
  }
  out.X_odom_wall = {solver.x[0], solver.x[1], wrapAngle(solver.x[2])};
  out.camera_turn = Eigen::Map<const Eigen::Vector3d>(&solver.x[3]);
  out.ground = Eigen::Map<const Eigen::Vector3d>(&solver.x[6]);
  out.offset_px = solver.x[9];
  out.agreeing_share =
      static_cast<double>(used.size()) / static_cast<double>(solver.outline.size());
  out.rms_sigma = std::sqrt(squares / static_cast<double>(used.size()));
  out.covariance.topLeftCorner<2, 2>().diagonal().array() += prior.camera_m * prior.camera_m;
  return out;
}

}  // namespace kiln::marker
