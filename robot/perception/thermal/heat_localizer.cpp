#include "robot/perception/thermal/heat_localizer.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "robot/perception/thermal/plate_fit.h"

namespace kiln {
namespace {

constexpr int kWidth_px = 160, kHeight_px = 120;  // Lepton 3.5
constexpr std::size_t kMaxViews = 240;            // half a minute of sweep; then the oldest goes
constexpr std::size_t kMaxHypotheses = 24;
constexpr std::size_t kMaxFitViews = 30;  // more views of one sweep add time, hardly any accuracy

/// One accepted blob of one image.
struct View {
  Stamp stamp;
  std::uint64_t image_seq = 0;
  thermal::PlateMeasurement measurement;
  double peak_k = 0.0;
  double box_px = 0.0;  ///< mean edge of the bounding box, for the baseline
  Eigen::Isometry3d X_camera_map = Eigen::Isometry3d::Identity();
  Eigen::Vector3d p_alone = Eigen::Vector3d::Zero();  ///< in map, if this view were all there is
  double range_alone_m = 0.0;
};

bool touchesBorder(const HeatBlob& blob) {
  return blob.u_min <= 0 || blob.v_min <= 0 || blob.u_max >= kWidth_px - 1 ||
         blob.v_max >= kHeight_px - 1;
}

}  // namespace

void HeatLocalizer::Config::visit(ConfigArchive& a) {
  a.field("plate_diameter_m", plate_diameter_m, "m", 0.01, 1, "hot plate");
  a.field("opening_m", opening_m, "m", 0.01, 1, "diameter of the round opening");
  a.field("recess_m", recess_m, "m", 0, 1, "plate behind the opening");
  a.field("hfov_deg", hfov_deg, "deg", 10, 120, "thermal camera's horizontal field of view");
  a.field("min_views", min_views, "", 1, 200, "pictures that must agree");
  a.field("max_range_m", max_range_m, "m", 0.2, 20, "farther sources are not believed");
  a.field("psf_sigma_px", psf_sigma_px, "px", 0, 3, "blur of optics and pixel together");
  a.field("gate_px", gate_px, "px", 1, 80, "a view whose centre is off by more does not agree");
  a.field("gate_size_ratio", gate_size_ratio, "", 0.05, 1,
          "nor one whose size is off by more than this share");
  a.field("centre_sigma_px", centre_sigma_px, "px", 0.01, 10, "noise of a blob centre");
  a.field("radius_sigma_px", radius_sigma_px, "px", 0.01, 10,
          "noise of a blob's equivalent radius");
  a.field("size_sigma_ratio", size_sigma_ratio, "", 0.0001, 0.5,
          "plate size and focal length, common error");
  a.field("normal_yaw_sigma_deg", normal_yaw_sigma_deg, "deg", 0.1, 45,
          "the fire box stands askew");
  a.field("extrinsic_sigma_m", extrinsic_sigma_m, "m", 0.0001, 0.1, "camera on the flange");
  a.field("extrinsic_sigma_deg", extrinsic_sigma_deg, "deg", 0.01, 10, "camera on the flange");
}

struct HeatLocalizer::Impl {
  explicit Impl(Config c)
      : config(c),
        camera(CameraModel::fromHorizontalFov(kWidth_px, kHeight_px, c.hfov_deg * kDeg)) {}

  /// Where the plate would be if this one view were right: along its ray, at the distance its area
  /// gives.
  [[nodiscard]] Eigen::Vector3d singleViewPosition(const View& view) const;
  [[nodiscard]] bool agrees(const View& view, const Eigen::Vector3d& p_map) const;
  [[nodiscard]] std::vector<const View*> largestConsensus() const;
  [[nodiscard]] std::optional<FireEstimate> solve() const;
  [[nodiscard]] thermal::PlateFit fit(const std::vector<const View*>& views) const;
  [[nodiscard]] double rangeOfRadius(double radius_px) const {
    return camera.fx * 0.5 * config.plate_diameter_m / radius_px;
  }

  Config config;
  CameraModel camera;
  std::vector<View> views;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  mutable bool solved = false;
  mutable std::optional<FireEstimate> cached;
};

HeatLocalizer::HeatLocalizer(Config config) : impl_(std::make_unique<Impl>(config)) {}
HeatLocalizer::~HeatLocalizer() = default;
HeatLocalizer::HeatLocalizer(HeatLocalizer&&) noexcept = default;
HeatLocalizer& HeatLocalizer::operator=(HeatLocalizer&&) noexcept = default;

void HeatLocalizer::begin() {
  impl_->views.clear();
  impl_->solved = false;
}

void HeatLocalizer::add(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal,
                        const Eigen::Vector3d& normal_prior) {
  if (!detections.usable || !isFinite(X_map_thermal) || !normal_prior.allFinite()) return;
  Eigen::Vector3d normal = normal_prior;
  normal.z() = 0;  // fire boxes stand on level tables
  if (normal.norm() < 1e-3) return;
  impl_->normal = normal.normalized();
  for (const HeatBlob& blob : detections.blobs) {
    if (blob.rejection != HeatRejection::None || touchesBorder(blob) ||
        !(blob.half_max_area_px > 0))
      continue;
    View view;
    view.stamp = detections.stamp;
    view.image_seq = detections.image_seq;
    view.measurement = {X_map_thermal, {{blob.u, blob.v}, blob.half_max_area_px}};
    view.peak_k = blob.peak_k;
    view.box_px = 0.5 * (blob.u_max - blob.u_min + blob.v_max - blob.v_min) + 1;
    view.X_camera_map = X_map_thermal.inverse();
    view.p_alone = impl_->singleViewPosition(view);
    view.range_alone_m = (view.p_alone - X_map_thermal.translation()).norm();
    impl_->views.push_back(view);
    impl_->solved = false;
  }
  if (impl_->views.size() > kMaxViews) {
    impl_->views.erase(impl_->views.begin(),
                       impl_->views.end() - static_cast<std::ptrdiff_t>(kMaxViews));
  }
}

std::optional<FireEstimate> HeatLocalizer::estimate() const {
  if (!impl_->solved) {
    impl_->cached = impl_->solve();
    impl_->solved = true;
  }
  return impl_->cached;
}

Eigen::Vector3d HeatLocalizer::Impl::singleViewPosition(const View& view) const {
  const Eigen::Vector3d ray = camera.ray(view.measurement.seen.centre_px);
  const Eigen::Vector3d ray_map = view.measurement.X_map_camera.linear() * ray;
  const double facing = std::clamp(-ray_map.dot(normal), 0.2, 1.0);
  const double radius_px = std::sqrt(view.measurement.seen.area_px / M_PI);
  // A tilted disc has area pi r^2 cos(angle); off the image centre a pixel covers less solid angle.
  const double range = rangeOfRadius(radius_px) * std::sqrt(facing) / std::pow(ray.z(), 1.5);
  return view.measurement.X_map_camera.translation() + ray_map * range;
}

bool HeatLocalizer::Impl::agrees(const View& view, const Eigen::Vector3d& p_map) const {
  const Eigen::Vector3d p_camera = view.X_camera_map * p_map;
  const auto pixel = camera.project(p_camera);
  if (!pixel || p_camera.norm() > config.max_range_m) return false;
  if ((*pixel - view.measurement.seen.centre_px).norm() > config.gate_px) return false;
  return std::abs(view.range_alone_m / p_camera.norm() - 1.0) <= config.gate_size_ratio;
}

std::vector<const View*> HeatLocalizer::Impl::largestConsensus() const {
  std::vector<const View*> best;
  const std::size_t step = std::max<std::size_t>(1, views.size() / kMaxHypotheses);
  for (std::size_t i = 0; i < views.size(); i += step) {
    const Eigen::Vector3d& p = views[i].p_alone;
    std::vector<const View*> agreeing;
    for (const View& view : views) {
      if (agrees(view, p)) agreeing.push_back(&view);
    }
    if (agreeing.size() > best.size()) best = std::move(agreeing);
  }
  return best;
}

thermal::PlateFit HeatLocalizer::Impl::fit(const std::vector<const View*>& agreeing) const {
  std::vector<thermal::PlateMeasurement> measurements;
  std::vector<Eigen::Vector3d> starts;
  const std::size_t n = std::min(agreeing.size(), kMaxFitViews);
  for (std::size_t i = 0; i < n; ++i) {
    const View& view = *agreeing[i * agreeing.size() / n];
    measurements.push_back(view.measurement);
    starts.push_back(view.p_alone);
  }
  Eigen::Vector3d initial;
  for (int axis = 0; axis < 3; ++axis) {
    std::nth_element(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(n / 2),
                     starts.end(),
                     [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    initial[axis] = starts[n / 2][axis];
  }
  const thermal::PlateModel model{config.plate_diameter_m, config.opening_m, config.recess_m,
                                  config.psf_sigma_px};
  thermal::PlateFitNoise noise;
  noise.centre_px = config.centre_sigma_px;
  noise.radius_px = config.radius_sigma_px;
  noise.size_ratio = config.size_sigma_ratio;
  noise.normal_yaw_rad = config.normal_yaw_sigma_deg * kDeg;
  noise.extrinsic_m = config.extrinsic_sigma_m;
  noise.extrinsic_rad = config.extrinsic_sigma_deg * kDeg;
  return thermal::fitPlate(model, camera, measurements, initial, normal, noise);
}

std::optional<FireEstimate> HeatLocalizer::Impl::solve() const {
  const std::vector<const View*> agreeing = largestConsensus();
  if (agreeing.size() < static_cast<std::size_t>(std::max(1, config.min_views)))
    return std::nullopt;
  const thermal::PlateFit plate = fit(agreeing);
  const View& last = *agreeing.back();
  const double range = (plate.p_map - last.measurement.X_map_camera.translation()).norm();
  if (!plate.p_map.allFinite() || !plate.covariance.allFinite() || range > config.max_range_m)
    return std::nullopt;
  FireEstimate out;
  out.stamp = last.stamp;
  out.p_map = plate.p_map;
  out.covariance = plate.covariance;
  out.views = static_cast<int>(agreeing.size());
  for (const View* view : agreeing) out.peak_k = std::max(out.peak_k, view->peak_k);
  out.range_m = range;
  out.baseline_range_m = camera.fx * config.plate_diameter_m / last.box_px;
  return out;
}

}  // namespace kiln
