#include "tests/support/thermal_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kiln::testing {
namespace {

constexpr int kWidth = 160, kHeight = 120, kRays = 6;

double temperatureAlong(const ThermalScene& s, const Eigen::Vector3d& eye,
                        const Eigen::Vector3d& ray) {
  // In the plate frame. The box's front lies at z = recess, the plate at z = 0.
  if (ray.z() >= 0 || eye.z() <= s.recess_m) return s.ambient_k;
  const Eigen::Vector3d front = eye + ray * ((s.recess_m - eye.z()) / ray.z());
  if ((front.head<2>() - s.opening_offset_m).norm() > 0.5 * s.opening_m) return s.ambient_k;
  const Eigen::Vector3d mid = eye + ray * ((0.5 * s.recess_m - eye.z()) / ray.z());
  if (s.flame_k > 0 && std::abs(mid.x()) < 0.04 && mid.y() > 0.0 && mid.y() < 0.06)
    return s.flame_k;
  const Eigen::Vector3d back = eye + ray * (-eye.z() / ray.z());
  return back.head<2>().norm() <= 0.5 * s.plate_m ? s.plate_k : s.ambient_k;
}

void blur(std::vector<float>& image, double sigma) {
  if (sigma <= 0) return;
  std::array<float, 7> kernel{};
  float sum = 0;
  for (int i = -3; i <= 3; ++i) {
    kernel[static_cast<std::size_t>(i + 3)] =
        static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += kernel[static_cast<std::size_t>(i + 3)];
  }
  for (auto& k : kernel) k /= sum;
  for (const bool rows : {true, false}) {
    const std::vector<float> in = image;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        float value = 0;
        for (int i = -3; i <= 3; ++i) {
          const int uu = rows ? std::clamp(u + i, 0, kWidth - 1) : u;
          const int vv = rows ? v : std::clamp(v + i, 0, kHeight - 1);
          value += kernel[static_cast<std::size_t>(i + 3)] *
                   in[static_cast<std::size_t>(vv * kWidth + uu)];
        }
        image[static_cast<std::size_t>(v * kWidth + u)] = value;
      }
    }
  }
}

}  // namespace

ThermalRenderer::ThermalRenderer(Config config, std::uint64_t seed)
    : config_(config),
      camera_(CameraModel::fromHorizontalFov(kWidth, kHeight, config.hfov_deg * M_PI / 180)),
      random_(seed),
      fixed_pattern_(kWidth * kHeight) {
  std::normal_distribution<float> pattern(0.0f, static_cast<float>(config.fixed_pattern_k));
  for (float& value : fixed_pattern_) value = config.fixed_pattern_k > 0 ? pattern(random_) : 0.0f;
}

ThermalImage ThermalRenderer::render(const ThermalScene& scene,
                                     const Eigen::Isometry3d& X_map_thermal) {
  const Eigen::Isometry3d X_plate_camera = scene.X_map_plate.inverse() * X_map_thermal;
  std::vector<std::pair<Eigen::Vector3d, const WarmDisc*>> discs;
  for (const WarmDisc& disc : scene.discs)
    discs.emplace_back(X_map_thermal.inverse() * disc.p_map, &disc);
  const auto seen = [&](double u, double v) {
    const Eigen::Vector3d ray = camera_.ray({u, v});
    for (const auto& [p, disc] : discs) {
      if (p.z() > 0 && (ray * (p.z() / ray.z()) - p).norm() < disc->radius_m) return disc->kelvin;
    }
    return temperatureAlong(scene, X_plate_camera.translation(), X_plate_camera.linear() * ray);
  };
  std::vector<float> kelvin(kWidth * kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      // Most pixels see one temperature: four corners and the centre tell.
      const double centre = seen(u, v);
      double sum = 0;
      bool uniform = true;
      for (const double du : {-0.5, 0.5}) {
        for (const double dv : {-0.5, 0.5}) uniform = uniform && seen(u + du, v + dv) == centre;
      }
      if (uniform) {
        kelvin[static_cast<std::size_t>(v * kWidth + u)] = static_cast<float>(centre);
        continue;
      }
      for (int i = 0; i < kRays * kRays; ++i) {
        sum += seen(u + (i % kRays + 0.5) / kRays - 0.5, v + (i / kRays + 0.5) / kRays - 0.5);
      }
      kelvin[static_cast<std::size_t>(v * kWidth + u)] = static_cast<float>(sum / (kRays * kRays));
    }
  }
  blur(kelvin, config_.blur_px);
  std::normal_distribution<float> noise(0.0f, static_cast<float>(std::max(1e-6, config_.noise_k)));
  ThermalImage image;
  image.seq = seq_;
  image.frame_counter = static_cast<std::uint32_t>(++seq_);
  image.counts.resize(kelvin.size());
  for (std::size_t i = 0; i < kelvin.size(); ++i) {
    image.counts[i] = static_cast<std::uint16_t>(
        std::lround((kelvin[i] + fixed_pattern_[i] + noise(random_)) * 100));
  }
  return image;
}

Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  X.linear().col(0) = x;
  X.linear().col(1) = z.cross(x);
  X.linear().col(2) = z;
  X.translation() = eye;
  return X;
}

}  // namespace kiln::testing
