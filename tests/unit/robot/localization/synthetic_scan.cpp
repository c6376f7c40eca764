#include "tests/unit/robot/localization/synthetic_scan.h"

#include <array>
#include <cmath>
#include <random>

#include "common/core/units.h"
#include "tests/support/kitchen.h"

namespace kiln::testing {
namespace {

/// Distance along a unit ray to a box, or infinity; the ray is given in the box frame.
double slab(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray,
            const std::vector<double>& size_m) {
  double near = 0.0, far = 1e9;
  for (int k = 0; k < 3; ++k) {
    const double half = 0.5 * size_m[static_cast<std::size_t>(k)];
    if (std::abs(ray[k]) < 1e-12) {
      if (std::abs(origin[k]) > half) return 1e9;
      continue;
    }
    const double a = (-half - origin[k]) / ray[k], b = (half - origin[k]) / ray[k];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far && near > 0.0 ? near : 1e9;
}

}  // namespace

ArenaMap kitchen() { return loadKitchen(); }

BoxConfig makeBox(double x, double y, double z, double sx, double sy, double sz) {
  return {"box", {{x, y, z}, {0, 0, 0}}, {sx, sy, sz}};
}

std::vector<BoxConfig> moved(std::vector<BoxConfig> boxes, double metres, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-metres, metres), turn(-5.0, 5.0);
  for (BoxConfig& box : boxes) {
    box.center.xyz_m[0] += shift(random);
    box.center.xyz_m[1] += shift(random);
    box.center.rpy_deg[2] += turn(random);
  }
  return boxes;
}

PointCloud castScan(const ScanSettings& settings, const Eigen::Isometry3d& X_map_base) {
  std::mt19937 random(settings.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::array<double, 16> bias{};
  for (double& b : bias) b = settings.bias_sigma_m * normal(random);
  const Eigen::Isometry3d X_map_sensor =
      X_map_base * Eigen::Translation3d(settings.p_base_sensor) * settings.X_sensor_truesensor;
  std::vector<Eigen::Isometry3d> X_box_sensor;
  for (const BoxConfig& box : settings.boxes)
    X_box_sensor.push_back(box.center.pose().inverse() * X_map_sensor);
  PointCloud cloud;
  cloud.frame = "base";
  for (int azimuth = 0; azimuth < settings.directions; ++azimuth) {
    for (int ring = 0; ring < 16; ++ring) {
      const double a = azimuth * 2.0 * M_PI / settings.directions, e = (-15.0 + 2.0 * ring) * kDeg;
      const Eigen::Vector3d ray(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const double down = -(X_map_sensor.linear() * ray).z();
      double range =
          settings.flat_floor ? X_map_sensor.translation().z() / std::max(1e-9, down) : 1e9;
      for (std::size_t i = 0; i < settings.boxes.size(); ++i) {
        range = std::min(range, slab(X_box_sensor[i].translation(), X_box_sensor[i].linear() * ray,
                                     settings.boxes[i].size_m));
      }
      if (range > 100.0 || uniform(random) < settings.dropout) continue;
      if (uniform(random) < settings.random_return_fraction) range *= 0.1 + 0.9 * uniform(random);
      range += bias[static_cast<std::size_t>(ring)] + settings.noise_sigma_m * normal(random);
      const Eigen::Vector3d p = settings.p_base_sensor + range * ray;
      cloud.push(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                 50, static_cast<std::uint8_t>(ring), 0.0F);
    }
  }
  return cloud;
}

PointCloud castScan(const ScanSettings& settings, const Pose2& X_map_base) {
  return castScan(settings, toIsometry(X_map_base));
}

}  // namespace kiln::testing
