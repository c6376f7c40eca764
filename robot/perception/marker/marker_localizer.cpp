#include "robot/perception/marker/marker_localizer.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "common/core/units.h"
#include "robot/perception/marker/marker_coverage.h"
#include "robot/perception/marker/marker_shape.h"

namespace kiln {
namespace {

using marker::Coverage;
using marker::GroundCluster;
using marker::OutlineFit;
using marker::PictureFrame;
using marker::SeenOutline;

constexpr int kWidth_px = 1280, kHeight_px = 720;

/// What is kept of a picture.
struct Picture {
  Stamp stamp;
  PictureFrame frame;
  Eigen::Isometry3d X_base_level = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d ground_covariance = Eigen::Matrix3d::Zero();
  double way_m = 0.0;                   ///< driven until then
  std::vector<Eigen::Vector3f> pixels;  ///< viewing rays, z = 1
  std::vector<SeenOutline> outline;
};

/// One ray on the ground.
struct Seen {
  std::size_t picture = 0, ray = 0;
};

Eigen::Vector3d viewingRay(const CameraModel& camera, const Eigen::Vector2f& pixel) {
  return {(static_cast<double>(pixel.x()) - camera.cx) / camera.fx,
          (static_cast<double>(pixel.y()) - camera.cy) / camera.fy, 1.0};
}

bool usable(const MarkerViewpoint& from) {
  const Pose2& X = from.X_odom_base;
  return isFinite(from.X_base_rgb) && std::isfinite(X.x_m) && std::isfinite(X.y_m) &&
         std::isfinite(X.yaw_rad) && from.ground.coefficients.allFinite() &&
         from.ground.covariance.allFinite();
}

}  // namespace

struct MarkerLocalizer::Impl {
  explicit Impl(const Config& c)
      : config(c),
        camera(CameraModel::fromHorizontalFov(kWidth_px, kHeight_px, c.hfov_deg * kDeg)) {}

  /// Everything that search() works on, in one place.
  struct Scene {
    std::vector<PictureFrame> frames;
    std::vector<Eigen::Vector2f> points;  ///< in odom
    std::vector<Seen> seen;               ///< parallel to points
    std::vector<SeenOutline> outline;
  };
  [[nodiscard]] Scene gather() const;
  [[nodiscard]] std::optional<RefusedMarker> refuseSides(const GroundCluster& cluster) const;
  [[nodiscard]] OutlineFit fit(const Scene& scene, const Pose2& start) const;
  /// @return why not; nullopt and `estimate` filled if it is the marker.
  [[nodiscard]] std::optional<RefusedMarker> judge(const Scene& scene, const GroundCluster& cluster,
                                                   MarkerEstimate& estimate) const;
  [[nodiscard]] std::optional<RefusedMarker> refuseCoverage(const Coverage& coverage) const;
  [[nodiscard]] Eigen::Matrix3d roughCovariance(const Pose2& X_odom_wall) const;

  Config config;
  CameraModel camera;
  std::deque<Picture> pictures;
};

MarkerLocalizer::MarkerLocalizer(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
MarkerLocalizer::~MarkerLocalizer() = default;
MarkerLocalizer::MarkerLocalizer(MarkerLocalizer&&) noexcept = default;
MarkerLocalizer& MarkerLocalizer::operator=(MarkerLocalizer&&) noexcept = default;
const CameraModel& MarkerLocalizer::camera() const { return impl_->camera; }
void MarkerLocalizer::reset() { impl_->pictures.clear(); }

void MarkerLocalizer::add(const MarkerView& view, const MarkerViewpoint& from) {
  auto& pictures = impl_->pictures;
  const Config& config = impl_->config;
  if (!usable(from) || view.width != kWidth_px || view.height != kHeight_px) return;
  if (!pictures.empty() && view.stamp <= pictures.back().stamp) return;
  Picture picture;
  picture.stamp = view.stamp;
  const Eigen::Quaterniond upright =
      Eigen::Quaterniond::FromTwoVectors(from.ground.normal(), Eigen::Vector3d::UnitZ());
  picture.X_base_level.linear() = upright.toRotationMatrix().transpose();
  picture.frame.X_level_rgb = picture.X_base_level.inverse() * from.X_base_rgb;
  picture.frame.ground_m = from.ground.coefficients[0] * from.ground.normal().z();
  picture.frame.X_odom_level = from.X_odom_base;
  picture.ground_covariance = from.ground.covariance;
  if (!pictures.empty()) {
    const Pose2 moved = inverse(pictures.back().frame.X_odom_level) * from.X_odom_base;
    picture.way_m = pictures.back().way_m + std::hypot(moved.x_m, moved.y_m);
  }
  for (std::size_t i = 0; i < view.clusters.size(); ++i) {
    const MarkerCluster& cluster = view.clusters[i];
    if (!cluster.refused.empty() || (config.paper && static_cast<int>(i) != view.winner)) continue;
    for (const Eigen::Vector2f& pixel : cluster.mask_pixels)
      picture.pixels.push_back(viewingRay(impl_->camera, pixel).cast<float>());
    const std::size_t stride =
        cluster.outline.size() / static_cast<std::size_t>(config.max_outline) + 1;
    for (std::size_t k = 0; k < cluster.outline.size(); k += stride) {
      const OutlinePoint& point = cluster.outline[k];
      picture.outline.push_back({0, viewingRay(impl_->camera, point.pixel),
                                 point.outward.cast<double>(), impl_->camera.fx});
    }
  }
  pictures.push_back(std::move(picture));
  while (toSeconds(pictures.back().stamp - pictures.front().stamp) > config.window_s ||
         static_cast<int>(pictures.size()) > config.max_pictures)
    pictures.pop_front();
}

MarkerLocalizer::Impl::Scene MarkerLocalizer::Impl::gather() const {
  Scene scene;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    PictureFrame frame = pictures[k].frame;
    frame.drift_m = config.odometry_drift * (pictures.back().way_m - pictures[k].way_m);
    const Eigen::Vector2d eye =
        (toIsometry(frame.X_odom_level) * frame.X_level_rgb).translation().head<2>();
    for (std::size_t i = 0; i < pictures[k].pixels.size(); ++i) {
      const Eigen::Vector2d p = frame.onGround(pictures[k].pixels[i].cast<double>());
      if (!((p - eye).norm() <= config.max_range_m)) continue;
      scene.points.push_back(p.cast<float>());
      scene.seen.push_back({k, i});
    }
    for (SeenOutline seen : pictures[k].outline) {
      seen.frame = k;
      scene.outline.push_back(seen);
    }
    scene.frames.push_back(frame);
  }
  return scene;
}

std::optional<RefusedMarker> MarkerLocalizer::Impl::refuseSides(
    const GroundCluster& cluster) const {
  const double a = cluster.rectangle.long_m, b = cluster.rectangle.short_m;
  const double tolerance = config.side_tolerance * kMarkerLength_m + config.side_tolerance_m;
  const auto fits = [&](double side) { return std::abs(side - kMarkerLength_m) <= tolerance; };
  if (fits(a) && fits(b)) return std::nullopt;
  RefusedMarker out;
  out.X_odom_sides = cluster.rectangle;
  const std::string sides =
      fmt::format("{:.2f} x {:.2f} m; {:.2f} x {:.2f} m, +-{:.2f} m, are looked for", a, b,
                  kMarkerLength_m, kMarkerLength_m, tolerance);
  constexpr double kStrip = 2.5;  // times the width of a leg
  if (a < kMarkerLength_m - tolerance) {
    out.why = MarkerRefusal::TooSmall;
    out.text = "too small, or half hidden: " + sides;
  } else if (b <= kStrip * kMarkerWidth_m) {
    out.why = MarkerRefusal::OneLeg;
    out.text = "a strip: only one leg of the marker is seen: " + sides;
  } else {
    out.why = b < kMarkerLength_m - tolerance && fits(a) ? MarkerRefusal::HalfHidden
                                                         : MarkerRefusal::WrongSides;
    out.text = (out.why == MarkerRefusal::HalfHidden ? "one leg is too short, or hidden: "
                                                     : "no marker by its sides: ") +
               sides;
  }
  return out;
}

OutlineFit MarkerLocalizer::Impl::fit(const Scene& scene, const Pose2& start) const {
  const Picture& newest = pictures.back();
  marker::OutlinePrior prior;
  prior.camera_rad = config.camera_sigma_deg * kDeg;
  prior.camera_m = config.camera_sigma_m;
  prior.ground = newest.ground_covariance;
  prior.ground.diagonal().array() += 1e-8;
  prior.ground(0, 0) += config.camera_sigma_m * config.camera_sigma_m;  // height of the camera
  // Only what lies about the cluster: other candidates have outlines too.
  std::vector<SeenOutline> near;
  constexpr double kMargin_m = 1.0;
  for (const SeenOutline& seen : scene.outline) {
    const Eigen::Vector2d p = scene.frames[seen.frame].onGround(seen.direction_rgb);
    const Eigen::Vector2d p_wall =
        (toIsometry(inverse(start)) * Eigen::Vector3d(p.x(), p.y(), 0.0)).head<2>();
    if (marker::distanceOutside(p_wall) <= kMargin_m) near.push_back(seen);
  }
  return marker::fitOutline(scene.frames, near, start, prior, config.fit);
}

Eigen::Matrix3d MarkerLocalizer::Impl::roughCovariance(const Pose2& X_odom_wall) const {
  const Picture& newest = pictures.back();
  const Pose2 X = inverse(newest.frame.X_odom_level) * X_odom_wall;
  const Eigen::Vector2d to =
      Eigen::Vector2d(X.x_m, X.y_m) - newest.frame.X_level_rgb.translation().head<2>();
  const double height = newest.frame.X_level_rgb.translation().z() - newest.frame.ground_m;
  const double tilt =
      std::hypot(config.camera_sigma_deg * kDeg, std::sqrt(newest.ground_covariance(1, 1)));
  const double along = (to.squaredNorm() / height + height) * tilt;
  const double across = to.norm() * config.camera_sigma_deg * kDeg + 0.05;
  const double bearing = std::atan2(to.y(), to.x()) + newest.frame.X_odom_level.yaw_rad;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(bearing).toRotationMatrix();
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  out.topLeftCorner<2, 2>() =
      R * Eigen::Vector2d(along * along, across * across).asDiagonal() * R.transpose();
  out(2, 2) = std::pow(along / kMarkerLength_m, 2);
  return out;
}

std::optional<RefusedMarker> MarkerLocalizer::Impl::refuseCoverage(const Coverage& c) const {
  if (const std::string hidden = c.hidden(config.min_coverage); !hidden.empty())
    return RefusedMarker{MarkerRefusal::HalfHidden, hidden, {}};
  if (c.outside <= config.max_outside) return std::nullopt;
  return RefusedMarker{MarkerRefusal::NoFit,
                       fmt::format("{:.0f} % of what has the marker's colours lies off its "
                                   "outline, {:.0f} % may",
                                   100.0 * c.outside, 100.0 * config.max_outside),
                       {}};
}

std::optional<RefusedMarker> MarkerLocalizer::Impl::judge(const Scene& scene,
                                                          const GroundCluster& cluster,
                                                          MarkerEstimate& estimate) const {
  if (auto refused = refuseSides(cluster)) return refused;
  const Picture& newest = pictures.back();
  const marker::LCorner corner = marker::findLCorner(cluster, scene.points);
  estimate.stamp = newest.stamp;
  estimate.pictures = static_cast<int>(pictures.size());
  estimate.rectangle = cluster.rectangle;
  estimate.X_odom_rectangle = corner.X_ground_wall;
  OutlineFit fitted;
  fitted.X_odom_wall = corner.X_ground_wall;
  fitted.covariance = roughCovariance(corner.X_ground_wall);
  if (config.refine) {
    fitted = fit(scene, corner.X_ground_wall);
    if (!fitted.converged || fitted.agreeing_share < config.min_agreeing)
      return RefusedMarker{MarkerRefusal::NoFit,
                           fmt::format("the marker's outline fits {:.0f} % of what is seen, {:.0f} "
                                       "% are needed",
                                       100.0 * fitted.agreeing_share, 100.0 * config.min_agreeing),
                           cluster.rectangle};
  }
  if (!config.paper) {
    std::vector<Eigen::Vector2d> p_wall;
    const Eigen::Isometry3d X_wall_odom = toIsometry(inverse(fitted.X_odom_wall));
    for (const std::size_t i : cluster.points) {
      const Seen& seen = scene.seen[i];
      const Eigen::Vector2d p = fitted.onGround(
          scene.frames[seen.picture], pictures[seen.picture].pixels[seen.ray].cast<double>());
      p_wall.emplace_back((X_wall_odom * Eigen::Vector3d(p.x(), p.y(), 0.0)).head<2>());
    }
    constexpr double kMargin_m = 0.12;
    const Coverage coverage = marker::coverageOf(p_wall, kMargin_m);
    estimate.coverage = coverage.whole;
    estimate.outside = coverage.outside;
    if (auto refused = refuseCoverage(coverage)) {
      refused->X_odom_sides = cluster.rectangle;
      return refused;
    }
  }
  estimate.X_odom_wall = fitted.X_odom_wall;
  estimate.covariance = fitted.covariance;
  estimate.camera_turn_rad = fitted.camera_turn;
  const double sigma_m = std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(estimate.covariance.topLeftCorner<2, 2>())
          .eigenvalues()
          .maxCoeff());
  const double sigma_deg = std::sqrt(estimate.covariance(2, 2)) / kDeg;
  if (!config.paper && !(sigma_m <= config.max_sigma_m && sigma_deg <= config.max_sigma_deg))
    return RefusedMarker{
        MarkerRefusal::Uncertain,
        fmt::format("known to {:.2f} m and {:.1f} deg only, {:.2f} m and {:.1f} deg are asked for",
                    sigma_m, sigma_deg, config.max_sigma_m, config.max_sigma_deg),
        cluster.rectangle};
  Eigen::Isometry3d X_level_wall =
      toIsometry(inverse(newest.frame.X_odom_level) * estimate.X_odom_wall);
  X_level_wall.translation().z() =
      newest.frame.ground_m + fitted.ground.dot(Eigen::Vector3d(1.0, X_level_wall.translation().x(),
                                                                X_level_wall.translation().y()));
  estimate.X_base_wall = newest.X_base_level * X_level_wall;
  return std::nullopt;
}

MarkerSearch MarkerLocalizer::search() const {
  MarkerSearch out;
  const Impl::Scene scene = impl_->gather();
  const Config& config = impl_->config;
  marker::GroundClusterConfig clustering{config.cell_m, config.gap_m, 1};
  if (impl_->pictures.size() >= 3) clustering.min_hits = config.min_hits;
  const auto clusters = marker::clusterGround(scene.points, clustering);
  for (const GroundCluster& cluster : clusters) {
    MarkerEstimate estimate;
    auto refused = impl_->judge(scene, cluster, estimate);
    if (!refused && !out.estimate)
      out.estimate = estimate;
    else if (refused)
      out.refused.push_back(*refused);
    if (config.paper) break;
  }
  if (clusters.empty())
    out.refused.push_back(
        {MarkerRefusal::NothingSeen,
         fmt::format("nothing with the marker's colours and pattern in {} picture{} of the last "
                     "{:.0f} s",
                     impl_->pictures.size(), impl_->pictures.size() == 1 ? "" : "s",
                     config.window_s),
         {}});
  return out;
}

std::optional<Eigen::Vector3d> winnerRay(const MarkerView& view, const CameraModel& camera) {
  if (view.winner < 0) return std::nullopt;
  const auto& pixels = view.clusters[static_cast<std::size_t>(view.winner)].mask_pixels;
  std::vector<float> u, v;
  for (const Eigen::Vector2f& p : pixels) {
    u.push_back(p.x());
    v.push_back(p.y());
  }
  const auto middle = static_cast<std::ptrdiff_t>(pixels.size() / 2);
  std::nth_element(u.begin(), u.begin() + middle, u.end());
  std::nth_element(v.begin(), v.begin() + middle, v.end());
  return viewingRay(camera, {u[pixels.size() / 2], v[pixels.size() / 2]});
}

}  // namespace kiln
