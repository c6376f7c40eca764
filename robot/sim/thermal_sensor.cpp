#include "robot/sim/thermal_sensor.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln::sim {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr int kTile = 4;            // pixels: a square of 16 rays makes a tighter packet than a row
constexpr double kRounding = 1e-6;  // of a frame: stamps are whole nanoseconds
constexpr float kSkyC = 10.0F;      // clear sky seen over the walls
constexpr double kZeroCelsius = 273.15;
constexpr float kWarmC = 36.0F;   // rims of cooler things matter to nobody
constexpr float kMotorC = 33.0F;  // joints of a working arm

}  // namespace

ThermalSensor::ThermalSensor(const ThermalConfig& config, const RobotGeometry& robot,
                             const TrueRobot& truth, const WetBoards& wet, std::uint64_t seed)
    : config_(config),
      robot_(robot),
      X_flange_thermal_(truth.X_flange_thermal),
      wet_(wet),
      camera_(CameraModel::fromHorizontalFov(kWidth, kHeight, config.hfov_deg * kDeg)),
      noise_(seed, "thermal") {
  Random random(seed, "thermal fixed");
  for (int i = 0; i < kWidth * kHeight; ++i)
    fixed_pattern_k_.push_back(static_cast<float>(random.normal(config.fixed_pattern_k)));
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const int tile = i / (kTile * kTile), inside = i % (kTile * kTile);
    const int u = tile % (kWidth / kTile) * kTile + inside % kTile;
    const int v = tile / (kWidth / kTile) * kTile + inside / kTile;
    pixels_.push_back(static_cast<std::size_t>(v * kWidth + u));
    pixel_rays_.push_back(camera_.ray({u, v}).cast<float>());
  }
  shutter_period_s_ = config.shutter_period_s *
                      (1.0 + random.uniform(-config.shutter_spread, config.shutter_spread));
  shutter_first_s_ = shutter_period_s_ * random.uniform(0.2, 1.0);
  rays_.resize(pixel_rays_.size());
  hits_.resize(pixel_rays_.size());
  tiled_celsius_.resize(pixel_rays_.size());
  celsius_.resize(pixel_rays_.size());
}

Stamp ThermalSensor::nextFrame(Stamp now) const {
  const double frame_s = 1.0 / config_.rate_hz;
  const auto index =
      static_cast<std::int64_t>(std::floor(toSeconds(now) / frame_s + kRounding)) + 1;
  return Stamp{fromSeconds(static_cast<double>(index) * frame_s)};
}

bool ThermalSensor::shutterClosed(Stamp now) const {
  const double since = toSeconds(now) - shutter_first_s_;
  return since >= 0.0 && std::fmod(since, shutter_period_s_) < config_.shutter_s;
}

Eigen::Isometry3d ThermalSensor::X_map_thermal(const SceneState& state) const {
  return state.X_map_base * robot_.X_base_flange(state.q) * X_flange_thermal_;
}

float ThermalSensor::surface(const Raycaster::Ray& ray, const Raycaster::Hit& hit,
                             const RayScene& scene) const {
  if (!hit.valid()) return kSkyC;
  const Material m = RayScene::material(hit);
  if (m == Material::ArmJoint) return kMotorC;
  const float t = static_cast<float>(scene.temperature(hit));
  if (m == Material::Plate || m == Material::Reflection) return t;
  // Walls and floor are never quite even: half a kelvin over metres.
  const Eigen::Vector3f p = ray.origin + hit.range * ray.direction;
  const auto box = wet_.empty() ? std::nullopt : scene.box(hit);
  const float wet = box ? static_cast<float>(wet_.coolness(*box, p.cast<double>(), now_)) : 0.0F;
  return t - wet + 0.3F * std::sin(1.1F * p.x() + 0.7F * p.z()) +
         0.2F * std::sin(1.7F * p.y() - 0.9F * p.x());
}

/// What the acrylic mirrors replaces a share of its own radiation (Schlick's approximation).
void ThermalSensor::mirrorOnAcrylic(std::span<const Raycaster::Ray> rays,
                                    std::span<const Raycaster::Hit> hits, const RayScene& scene,
                                    std::vector<float>& celsius) const {
  std::vector<std::size_t> where;
  std::vector<Raycaster::Ray> mirrored;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].valid() || RayScene::material(hits[i]) != Material::Acrylic) continue;
    const Eigen::Vector3f n = hits[i].normal, d = rays[i].direction;
    Raycaster::Ray ray = rays[i];
    ray.direction = d - 2.0F * d.dot(n) * n;
    ray.origin = rays[i].origin + hits[i].range * d + 0.001F * n;
    where.push_back(i);
    mirrored.push_back(ray);
  }
  std::vector<Raycaster::Hit> seen(mirrored.size());
  scene.rays().cast(mirrored, seen);
  const float r0 = static_cast<float>(config_.acrylic_reflectance);
  for (std::size_t k = 0; k < where.size(); ++k) {
    const std::size_t i = where[k];
    const float grazing = 1.0F - std::fabs(rays[i].direction.dot(hits[i].normal));
    const float share = r0 + (1.0F - r0) * std::pow(grazing, 5.0F);
    celsius[i] += share * (surface(mirrored[k], seen[k], scene) - celsius[i]);
  }
}

void ThermalSensor::castPixels(const SceneState& state, const RayScene& scene) {
  now_ = state.stamp;
  const Eigen::Isometry3d X = X_map_thermal(state);
  const Eigen::Matrix3f R = X.linear().cast<float>();
  const Eigen::Vector3f origin = X.translation().cast<float>();
  for (std::size_t i = 0; i < rays_.size(); ++i)
    rays_[i] = {origin, R * pixel_rays_[i], 1e4F, mask::kThermal};
  scene.rays().cast(rays_, hits_, true);
  for (std::size_t i = 0; i < rays_.size(); ++i)
    tiled_celsius_[i] = surface(rays_[i], hits_[i], scene);
  mirrorOnAcrylic(rays_, hits_, scene, tiled_celsius_);
  for (std::size_t i = 0; i < rays_.size(); ++i) celsius_[pixels_[i]] = tiled_celsius_[i];
  refineEdges(X, scene);
}

/// A pixel integrates over its area: along the rim of something warm, sixteen rays instead of one.
void ThermalSensor::refineEdges(const Eigen::Isometry3d& X, const RayScene& scene) {
  constexpr int kSide = 4, kRays = kSide * kSide;
  std::vector<std::size_t> edges;
  std::vector<Raycaster::Ray> rays;
  const Eigen::Matrix3f R = X.linear().cast<float>();
  const Eigen::Vector3f origin = X.translation().cast<float>();
  for (int v = 1; v + 1 < kHeight; ++v) {
    for (int u = 1; u + 1 < kWidth; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * kWidth + u);
      const auto warmEdge = [&](std::size_t j) {
        return std::max(celsius_[i], celsius_[j]) > kWarmC &&
               std::fabs(celsius_[j] - celsius_[i]) > 2.0F;
      };
      if (!warmEdge(i - 1) && !warmEdge(i + 1) && !warmEdge(i - kWidth) && !warmEdge(i + kWidth))
        continue;
      edges.push_back(i);
      for (int k = 0; k < kRays; ++k) {
        const Eigen::Vector2d at(u + (k % kSide + 0.5) / kSide - 0.5,
                                 v + (k / kSide + 0.5) / kSide - 0.5);
        rays.push_back({origin, R * camera_.ray(at).cast<float>(), 1e4F, mask::kThermal});
      }
    }
  }
  std::vector<Raycaster::Hit> hits(rays.size());
  scene.rays().cast(rays, hits, true);
  std::vector<float> celsius(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) celsius[i] = surface(rays[i], hits[i], scene);
  mirrorOnAcrylic(rays, hits, scene, celsius);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    float sum = 0.0F;
    for (std::size_t k = 0; k < kRays; ++k) sum += celsius[e * kRays + k];
    celsius_[edges[e]] = sum / kRays;
  }
}

/// Optics: Gaussian over 3 pixels, rows then columns.
void ThermalSensor::blur() {
  if (config_.blur_px <= 0.0) return;
  const float side = static_cast<float>(std::exp(-0.5 / (config_.blur_px * config_.blur_px)));
  const float centre = 1.0F / (1.0F + 2.0F * side), edge = side * centre;
  const auto pass = [&](int count, int stride, int lines, int line_stride) {
    row_.resize(static_cast<std::size_t>(count));
    for (int line = 0; line < lines; ++line) {
      float* const first = celsius_.data() + line * line_stride;
      for (int i = 0; i < count; ++i) row_[static_cast<std::size_t>(i)] = first[i * stride];
      for (int i = 0; i < count; ++i) {
        const float before = row_[static_cast<std::size_t>(std::max(0, i - 1))];
        const float after = row_[static_cast<std::size_t>(std::min(count - 1, i + 1))];
        first[i * stride] = centre * row_[static_cast<std::size_t>(i)] + edge * (before + after);
      }
    }
  };
  pass(kWidth, 1, kHeight, kWidth);
  pass(kHeight, kWidth, kWidth, 1);
}

std::vector<std::uint16_t> ThermalSensor::counts() {
  std::vector<std::uint16_t> out(celsius_.size());
  const float noise = static_cast<float>(config_.noise_k);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float kelvin = celsius_[i] + static_cast<float>(kZeroCelsius) + fixed_pattern_k_[i] +
                         noise * noise_.normal();
    out[i] = static_cast<std::uint16_t>(std::clamp(100.0F * kelvin + 0.5F, 0.0F, 65535.0F));
  }
  return out;
}

ThermalImagePtr ThermalSensor::capture(const SceneState& state, const RayScene& scene, bool stuck) {
  const bool shutter = shutterClosed(state.stamp);
  if ((!shutter && !stuck) || last_.empty()) {
    castPixels(state, scene);
    blur();
    last_ = counts();
    ++frame_counter_;
  }
  auto image = std::make_shared<ThermalImage>();
  image->stamp = state.stamp;
  image->seq = ++seq_;
  image->frame_counter = frame_counter_;
  image->width = kWidth;
  image->height = kHeight;
  image->counts = last_;
  image->ffc = shutter ? FfcState::Running : FfcState::Complete;
  return image;
}

}  // namespace kiln::sim
