#include "robot/perception/cloud/box_locator.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kCell = 0.02;          // m, of the likelihood grid
constexpr double kCoarseSigma = 0.035;  // m
constexpr double kMargin = 0.12;        // m, of the grid around the object
constexpr int kIterations = 25;
constexpr double kSegment = 0.05;  // m, of a bar, for the coverage

Eigen::Isometry3d poseOf(const Eigen::Vector4d& x) {
  return makePose({x[0], x[1], x[3]}, {0, 0, x[2]});
}

}  // namespace

void BoxLocator::Config::visit(ConfigArchive& a) {
  a.field("search_m", search_m, "m", 0.1, 2, "each side of the configured place");
  a.field("search_deg", search_deg, "deg", 0, 45, "each side of the configured yaw");
  a.field("search_step_m", search_step_m, "m", 0.01, 0.2, "of the coarse search");
  a.field("search_step_deg", search_step_deg, "deg", 0.5, 20, "of the coarse search");
  a.field("voxel_m", voxel_m, "m", 0.005, 0.2, "thinning, a scan");
  a.field("max_points", max_points, "", 100, 100000, "used for the fit");
  a.field("min_points", min_points, "", 10, 10000, "on frame and table; fewer: unseen");
  a.field("min_coverage", min_coverage, "", 0, 1, "of the box's front bars; less: unseen");
  a.field("coarse_gate_m", coarse_gate_m, "m", 0.02, 0.5, "first iterations of the fit");
  a.field("fine_gate_m", fine_gate_m, "m", 0.01, 0.5, "last iterations");
  a.field("noise_m", noise_m, "m", 0.001, 0.1, "one sigma of a point");
  a.field("height_sigma_m", height_sigma_m, "m", 0.001, 0.2, "one sigma of the height");
  a.field("max_axis_m", max_axis_m, "m", 0.02, 1, "beyond it along an axis of map: misplaced");
  a.field("max_offset_m", max_offset_m, "m", 0.02, 1, "beyond this distance: misplaced");
  a.field("max_yaw_deg", max_yaw_deg, "deg", 1, 45, "turned by more: misplaced");
}

BoxLocator::BoxLocator(Config config) : config_(config), faces_(fireBoxFaces(config.sizes)) {
  fillGrid();
}

void BoxLocator::fillGrid() {
  const FireBoxSizes& s = config_.sizes;
  const double half_y = 0.5 * std::max(s.table, s.box) + kMargin;
  grid_low_ = {std::min(-s.box, s.table_ahead - s.table) - kMargin, -half_y,
               -0.5 * s.box - s.table_height};
  const Eigen::Vector3d high(s.table_ahead + kMargin, half_y, 0.5 * s.box + kMargin);
  grid_size_ = ((high - grid_low_) / kCell).array().ceil().cast<int>();
  grid_.assign(static_cast<std::size_t>(grid_size_.prod()), 0.0f);
  // Inner faces of the bars would be seen from everywhere: only what some sensor sees from outside
  // is asked for, so the sensor is put far out on the face's own side.
  std::size_t i = 0;
  for (int z = 0; z < grid_size_.z(); ++z) {
    for (int y = 0; y < grid_size_.y(); ++y) {
      for (int x = 0; x < grid_size_.x(); ++x, ++i) {
        const Eigen::Vector3d p =
            grid_low_ + kCell * (Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.5));
        double nearest = 3.0 * kCoarseSigma;
        for (const Face& face : faces_) {
          const Eigen::Vector3d d = p - face.centre;
          const double off = d.dot(face.n);
          if (std::abs(off) >= nearest) continue;
          const double a = std::max(0.0, std::abs(d.dot(face.u)) - face.half_u);
          const double b = std::max(0.0, std::abs(d.dot(face.v)) - face.half_v);
          nearest = std::min(nearest, Eigen::Vector3d(off, a, b).norm());
        }
        const double sigmas = nearest / kCoarseSigma;
        grid_[i] = sigmas >= 3.0 ? 0.0f : static_cast<float>(std::exp(-0.5 * sigmas * sigmas));
      }
    }
  }
}

float BoxLocator::likelihood(const Eigen::Vector3d& p) const {
  const Eigen::Vector3i cell = ((p - grid_low_) / kCell).array().floor().cast<int>();
  if ((cell.array() < 0).any() || (cell.array() >= grid_size_.array()).any()) return 0.0f;
  return grid_[static_cast<std::size_t>(cell.x() +
                                        grid_size_.x() * (cell.y() + grid_size_.y() * cell.z()))];
}

std::vector<BoxLocator::Sample> BoxLocator::gather(
    const Eigen::Isometry3d& X_map_front, const std::deque<ScanWindow::Entry>& scans) const {
  const FireBoxSizes& s = config_.sizes;
  const double reach = config_.search_m + 0.5 * std::max(s.table, s.box) + kMargin;
  const double middle = 0.5 * (s.table_ahead + std::min(-s.box, s.table_ahead - s.table));
  const double low = -0.5 * s.box - s.table_height + 0.05, high = 0.5 * s.box + 0.10;
  std::vector<Sample> out;
  for (const ScanWindow::Entry& entry : scans) {
    const Eigen::Isometry3d X_front_base = X_map_front.inverse() * entry.X_map_base;
    const Eigen::Vector3d p_sensor = X_front_base * entry.X_base_lidar.translation();
    std::unordered_set<std::uint64_t> taken;
    const PointCloud& scan = *entry.scan_base;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Eigen::Vector3d p = X_front_base * Eigen::Vector3d(scan.x[i], scan.y[i], scan.z[i]);
      if (!(std::abs(p.x() - middle) < reach && std::abs(p.y()) < reach && p.z() > low &&
            p.z() < high))
        continue;
      const auto cell = [&](double v) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(v / config_.voxel_m) + 4096);
      };
      if (!taken.insert(cell(p.x()) << 26 | cell(p.y()) << 13 | cell(p.z())).second) continue;
      out.push_back({p, p_sensor});
    }
  }
  const auto limit = static_cast<std::size_t>(config_.max_points);
  if (out.size() > limit) {
    const double stride = static_cast<double>(out.size()) / static_cast<double>(limit);
    for (std::size_t k = 0; k < limit; ++k)
      out[k] = out[static_cast<std::size_t>(static_cast<double>(k) * stride)];
    out.resize(limit);
  }
  return out;
}

/// Best (x, y, yaw) on the grid of the search.
Eigen::Vector3d BoxLocator::search(const std::vector<Sample>& samples) const {
  const int n = static_cast<int>(std::ceil(config_.search_m / config_.search_step_m));
  const int m = static_cast<int>(std::ceil(config_.search_deg / config_.search_step_deg));
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / 700);
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  float best_score = -1.0f;
  std::vector<Eigen::Vector3d> turned;
  for (int k = -m; k <= m; ++k) {
    const double yaw = k * config_.search_step_deg * kDeg;
    const Eigen::AngleAxisd R(-yaw, Eigen::Vector3d::UnitZ());
    turned.clear();
    for (std::size_t i = 0; i < samples.size(); i += stride) turned.push_back(R * samples[i].p);
    for (int ix = -n; ix <= n; ++ix) {
      for (int iy = -n; iy <= n; ++iy) {
        const Eigen::Vector3d shift(ix * config_.search_step_m, iy * config_.search_step_m, 0);
        const Eigen::Vector3d back = R * shift;
        float score = 0.0f;
        for (const Eigen::Vector3d& p : turned) score += likelihood(p - back);
        if (score <= best_score) continue;
        best_score = score;
        best = {shift.x(), shift.y(), yaw};
      }
    }
  }
  return best;
}

/// Gauss-Newton: how the faces that are seen pull at (x, y, yaw, z).
BoxLocator::Pull BoxLocator::pullAt(const std::vector<Sample>& samples, const Eigen::Vector4d& x,
                                    double gate_m) const {
  Pull pull;
  const Eigen::Isometry3d X_front = poseOf(x), X_back = X_front.inverse();
  for (const Sample& sample : samples) {
    const Eigen::Vector3d p = X_back * sample.p;
    const auto near = nearestFace(faces_, p, X_back * sample.p_sensor, gate_m);
    if (!near) continue;
    ++pull.inliers;
    // Towards a face along its normal; beyond its edge straight to the edge.
    const Eigen::Vector3d off = p - near->p;
    const double d = near->distance_m;
    Eigen::Vector3d direction = near->face->n;
    if (d > 1e-4 && std::abs(off.dot(direction)) < 0.999 * d) direction = off / d;
    const double r = off.dot(direction);
    // dp/d(x, y, z) = -R^T, dp/dyaw = p turned by -90 deg.
    const Eigen::Vector3d n_out = X_front.linear() * direction;
    Eigen::Vector4d J;
    J << -n_out.x(), -n_out.y(), direction.dot(Eigen::Vector3d(p.y(), -p.x(), 0)), -n_out.z();
    const double c = 0.5 * gate_m;
    const double weight = 1.0 / (1.0 + (r / c) * (r / c));  // Cauchy
    pull.H += weight * J * J.transpose();
    pull.g += weight * J * r;
  }
  return pull;
}

BoxLocator::Fit BoxLocator::refine(const std::vector<Sample>& samples,
                                   const Eigen::Vector3d& start) const {
  const double noise2 = config_.noise_m * config_.noise_m;
  const double height2 = config_.height_sigma_m * config_.height_sigma_m;
  Fit fit;
  fit.x << start, 0.0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const double share = std::min(1.0, iteration / (0.6 * kIterations));
    const double gate =
        config_.coarse_gate_m * std::pow(config_.fine_gate_m / config_.coarse_gate_m, share);
    const Pull pull = pullAt(samples, fit.x, gate);
    fit.inliers = pull.inliers;
    fit.information = pull.H / noise2;
    fit.information(3, 3) += 1.0 / height2;
    Eigen::Vector4d b = pull.g / noise2;
    b[3] += fit.x[3] / height2;
    const Eigen::Matrix4d A = fit.information + 1e-6 * Eigen::Matrix4d::Identity();
    const Eigen::Vector4d step = -A.ldlt().solve(b);
    fit.x += step;
    if (share >= 1.0 && step.norm() < 1e-5) break;
  }
  return fit;
}

/// Share of the box's own front (four bars and the rim, in pieces) that has a point near it. The
/// table alone does not make a fire box.
double BoxLocator::coverage(const std::vector<Sample>& samples, const Eigen::Vector4d& x) const {
  const Eigen::Isometry3d X_back = poseOf(x).inverse();
  const double half = 0.5 * (config_.sizes.box - config_.sizes.bar);
  const int pieces = static_cast<int>(std::ceil(2.0 * half / kSegment));
  std::vector<bool> seen(static_cast<std::size_t>(4 * pieces), false);
  for (const Sample& sample : samples) {
    const Eigen::Vector3d p = X_back * sample.p;
    if (std::abs(p.x()) > 0.05) continue;
    for (int side = 0; side < 4; ++side) {
      const double along = side < 2 ? p.z() : p.y(), across = side < 2 ? p.y() : p.z();
      if (std::abs(across - (side % 2 == 0 ? half : -half)) > 0.03 || std::abs(along) > half)
        continue;
      const int piece = std::min(pieces - 1, static_cast<int>((along + half) / kSegment));
      seen[static_cast<std::size_t>(side * pieces + piece)] = true;
    }
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) /
         static_cast<double>(seen.size());
}

void BoxLocator::judge(PlaceCheck& check) const {
  const Pose2 off = check.correction(config_.sizes.recess);
  check.offset_m = std::hypot(off.x_m, off.y_m);
  check.yaw_offset_rad = off.yaw_rad;
  const double axis = std::max(std::abs(off.x_m), std::abs(off.y_m));
  const bool shifted = check.offset_m > config_.max_offset_m || axis > config_.max_axis_m;
  const bool turned = std::abs(check.yaw_offset_rad) > config_.max_yaw_deg * kDeg;
  check.verdict = shifted || turned ? PlaceVerdict::Misplaced : PlaceVerdict::Fits;
  check.reason =
      shifted || turned
          ? fmt::format(
                "{} stands {:.0f} cm and {:.0f} deg off its configured place; look at both, "
                "nudge the place or correct the map",
                check.place, 100.0 * check.offset_m, check.yaw_offset_rad / kDeg)
          : fmt::format("{} stands {:.0f} cm and {:.0f} deg off, as usual", check.place,
                        100.0 * check.offset_m, check.yaw_offset_rad / kDeg);
}

PlaceCheck BoxLocator::check(const std::string& place, const Eigen::Isometry3d& X_map_front,
                             const std::deque<ScanWindow::Entry>& scans) const {
  PlaceCheck out;
  out.place = place;
  out.X_map_configured = X_map_front;
  if (!scans.empty()) out.stamp = scans.back().scan_base->stamp;
  const std::vector<Sample> samples = gather(X_map_front, scans);
  Fit fit;
  if (!samples.empty()) fit = refine(samples, search(samples));
  out.points = fit.inliers;
  out.coverage = coverage(samples, fit.x);
  if (fit.inliers < config_.min_points || out.coverage < config_.min_coverage) {
    out.reason = fmt::format(
        "{} was not found within {:.0f} cm of its configured place ({} points, {:.0f} % of its "
        "frame); look at the cloud, nudge the place or go on by hand",
        place, 100.0 * config_.search_m, fit.inliers, 100.0 * out.coverage);
    return out;
  }
  out.X_map_sensed = X_map_front * poseOf(fit.x);
  const Eigen::Matrix3d C =
      (fit.information + 1e-6 * Eigen::Matrix4d::Identity()).inverse().topLeftCorner<3, 3>();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = X_map_front.linear().topLeftCorner<2, 2>();
  out.covariance = R * C * R.transpose();
  judge(out);
  return out;
}

}  // namespace kiln
