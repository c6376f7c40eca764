#include "robot/perception/calibration/camera_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "common/core/units.h"
#include "common/geom/camera_model.h"
#include "robot/perception/calibration/robot_edges.h"

namespace kiln {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Brightness with sub-pixel places; -1 outside.
class Grey {
 public:
  explicit Grey(const RgbImage& image) : width_(image.width), height_(image.height) {
    values_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = 0.30f * static_cast<float>(image.data[3 * i]) +
                   0.59f * static_cast<float>(image.data[3 * i + 1]) +
                   0.11f * static_cast<float>(image.data[3 * i + 2]);
  }
  [[nodiscard]] double at(const Eigen::Vector2d& px) const {
    const double x = std::floor(px.x()), y = std::floor(px.y());
    if (x < 0 || y < 0 || x + 1 >= width_ || y + 1 >= height_) return -1.0;
    const auto value = [&](double u, double v) {
      return static_cast<double>(
          values_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(u)]);
    };
    const double a = px.x() - x, b = px.y() - y;
    return (1 - b) * ((1 - a) * value(x, y) + a * value(x + 1, y)) +
           b * ((1 - a) * value(x, y + 1) + a * value(x + 1, y + 1));
  }

 private:
  int width_, height_;
  std::vector<float> values_;
};

/// Where across an edge the brightness changes most: distance along `normal`, px.
std::optional<double> findStep(const Grey& grey, const Eigen::Vector2d& px,
                               const Eigen::Vector2d& normal, double reach_px, double min_step) {
  constexpr double kStep = 0.5, kSide = 2.0;  // px; the mean of both sides is compared
  const int half = static_cast<int>(reach_px / kStep);
  std::vector<double> steps(static_cast<std::size_t>(2 * half + 1), 0.0);
  std::size_t best = 0;
  for (int i = -half; i <= half; ++i) {
    double difference = 0.0;
    for (const double side : {0.5, 1.0, 1.5, kSide}) {
      const double plus = grey.at(px + (i * kStep + side) * normal),
                   minus = grey.at(px + (i * kStep - side) * normal);
      if (plus < 0.0 || minus < 0.0) return std::nullopt;
      difference += 0.25 * (plus - minus);
    }
    const auto k = static_cast<std::size_t>(i + half);
    // A near step is likelier to be this edge than a far one.
    steps[k] = std::abs(difference) * (1.0 - 0.4 * std::abs(i * kStep) / reach_px);
    if (steps[k] > steps[best]) best = k;
  }
  if (steps[best] < min_step || best == 0 || best + 1 == steps.size()) return std::nullopt;
  const double l = steps[best - 1], m = steps[best], r = steps[best + 1];
  const double curve = l - 2 * m + r;
  const double shift = std::abs(curve) > 1e-9 ? std::clamp(0.5 * (l - r) / curve, -0.5, 0.5) : 0.0;
  return (static_cast<double>(best) - half + shift) * kStep;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& X, const Vector6& x) {
  return X * makePose(x.tail<3>(), Eigen::Vector3d::Zero()) *
         makePose(Eigen::Vector3d::Zero(), x.head<3>());
}

struct View {
  Grey grey;
  CameraModel camera;
  std::vector<EdgePoint> edges;
};

struct Round {
  Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 g = Vector6::Zero();
  double squares = 0.0;
  int points = 0;
};

/// Adds what one picture says.
void measure(const View& view, const Eigen::Isometry3d& X_base_camera, double reach_px,
             const CameraCalibrator::Config& config, Round& out) {
  const auto project = [&](const Eigen::Isometry3d& X, const Eigen::Vector3d& p) {
    return view.camera.project(X.inverse() * p);
  };
  for (const EdgePoint& edge : view.edges) {
    const auto px = project(X_base_camera, edge.p), beside = project(X_base_camera, edge.along);
    if (!px || !beside || (*beside - *px).norm() < 1e-3) continue;
    const Eigen::Vector2d along = (*beside - *px).normalized();
    const Eigen::Vector2d normal(-along.y(), along.x());
    const auto step = findStep(view.grey, *px, normal, reach_px, config.min_step_grey);
    if (!step) continue;
    Vector6 J;
    for (int i = 0; i < 6; ++i) {
      constexpr double kH = 1e-5;
      Vector6 h = Vector6::Zero();
      h[i] = kH;
      const auto moved_px = project(moved(X_base_camera, h), edge.p);
      J[i] = moved_px ? normal.dot(*moved_px - *px) / kH : 0.0;
    }
    const double scale = std::max(1.0, reach_px / 4.0);
    const double weight = 1.0 / (1.0 + (*step / scale) * (*step / scale));
    const double information = weight / (config.noise_px * config.noise_px);
    out.H += information * J * J.transpose();
    out.g += information * J * *step;
    if (std::abs(*step) < 3.0 * scale) {
      out.squares += *step * *step;
      ++out.points;
    }
  }
}

bool whole(const RgbImagePtr& picture) {
  if (!picture || picture->width <= 0 || picture->height <= 0) return false;
  return picture->data.size() ==
         3 * static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height);
}

}  // namespace

void CameraCalibrator::Config::visit(ConfigArchive& a) {
  a.field("hfov_deg", hfov_deg, "deg", 10, 150, "horizontal field of view");
  a.field("sample_m", sample_m, "m", 0.005, 0.2, "between two points of an edge");
  a.field("search_px", search_px, "px", 3, 100, "across an edge, in the first rounds");
  a.field("min_step_grey", min_step_grey, "", 1, 200, "difference of brightness of an edge");
  a.field("noise_px", noise_px, "px", 0.05, 10, "one sigma of a found edge");
  a.field("prior_m", prior_m, "m", 0.001, 1, "prior of the mounting");
  a.field("prior_deg", prior_deg, "deg", 0.1, 45, "prior of the mounting");
  a.field("rounds", rounds, "", 3, 100, "of looking and solving");
  a.field("min_points", min_points, "", 10, 10000, "fewer are refused");
}

Result<Extrinsics> CameraCalibrator::calibrate(std::span<const RobotPicture> pictures,
                                               const RobotGeometry& robot,
                                               const Eigen::Isometry3d& X_base_camera) const {
  std::vector<View> views;
  for (const RobotPicture& seen : pictures) {
    if (!whole(seen.picture))
      return makeError(ErrorCode::InvalidInput, "a picture of the operator camera is not whole");
    views.push_back({Grey(*seen.picture),
                     CameraModel::fromHorizontalFov(seen.picture->width, seen.picture->height,
                                                    config_.hfov_deg * kDeg),
                     visibleEdges(robot, seen.q, X_base_camera.translation(), config_.sample_m)});
  }
  const double r2 = std::pow(config_.prior_deg * kDeg, 2), t2 = config_.prior_m * config_.prior_m;
  Vector6 prior;
  prior << 1 / r2, 1 / r2, 1 / r2, 1 / t2, 1 / t2, 1 / t2;
  Extrinsics out;
  out.X_parent_sensor = X_base_camera;
  Vector6 total = Vector6::Zero();
  Round round;
  for (int k = 0; k < config_.rounds; ++k) {
    const double share = std::min(1.0, static_cast<double>(k) / (0.6 * config_.rounds));
    round = Round{};
    for (const View& view : views)
      measure(view, out.X_parent_sensor, config_.search_px * (1.0 - 0.67 * share), config_, round);
    if (round.points < config_.min_points)
      return makeError(ErrorCode::Degenerate,
                       "{} points on the robot's edges are seen by the operator camera; {} are "
                       "needed: is it dark, or the lens covered?",
                       round.points, config_.min_points);
    if (k == 0) out.rms_before = std::sqrt(round.squares / round.points);
    round.H.diagonal() += prior;
    const Vector6 step = round.H.ldlt().solve(Vector6(round.g - prior.cwiseProduct(total)));
    total += step;
    out.X_parent_sensor = moved(out.X_parent_sensor, step);
  }
  const Eigen::Matrix<double, 6, 6> C = round.H.inverse();
  out.sigma_rad = C.diagonal().head<3>().cwiseSqrt();
  out.sigma_m = C.diagonal().tail<3>().cwiseSqrt();
  out.rms_after = std::sqrt(round.squares / round.points);
  out.unit = "px";
  out.views = static_cast<int>(views.size());
  out.measurements = round.points;
  return out;
}

}  // namespace kiln
