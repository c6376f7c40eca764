#include "gui/link/fake_sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

#include "common/geom/frames.h"

namespace kiln::gui {

namespace {
constexpr double kMaxRange_m = 30.0;
constexpr double kKelvin = 273.15;
constexpr double kThreshold_c = 80.0;

struct Hit {
  double range = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::uint32_t rgb = 0x5f6469;
};

/// First hit of a ray in map; boxes of the arena are axis-aligned.
Hit cast(const std::vector<SceneBox>& boxes, const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
  Hit hit;
  if (d.z() < -1e-6) hit.range = -p.z() / d.z();
  for (const SceneBox& box : boxes) {
    const Eigen::Vector3d o = p - box.X_map_box.translation();
    double near = 0.0;
    double far = hit.range;
    int axis = -1;
    for (int i = 0; i < 3 && near <= far; ++i) {
      const double inv = 1.0 / d[i];
      double a = (-box.half_extent[i] - o[i]) * inv;
      double b = (box.half_extent[i] - o[i]) * inv;
      if (a > b) std::swap(a, b);
      if (a > near) {
        near = a;
        axis = i;
      }
      far = std::min(far, b);
    }
    if (near > far || axis < 0 || near >= hit.range) continue;
    hit = {near, Eigen::Vector3d::Zero(), box.rgb};
    hit.normal[axis] = d[axis] > 0 ? -1.0 : 1.0;
  }
  return hit;
}
}  // namespace

PointCloudPtr makeFakeCloud(const FakeRobot& robot, std::uint64_t seq) {
  constexpr int kRings = 16;
  constexpr int kColumns = 900;
  const std::vector<SceneBox> boxes = makeFakeArena();
  const RobotGeometry& g = robot.geometry();
  const Eigen::Isometry3d X_map_lidar =
      toIsometry(robot.pose()) * g.X_base_flange(robot.joints()) * g.X_flange_lidar.pose();
  std::mt19937_64 random(seq);
  std::normal_distribution<double> noise(0.0, 0.01);
  auto cloud = std::make_shared<PointCloud>();
  cloud->stamp = robot.now();
  cloud->seq = seq;
  cloud->frame = frames::kLidar;
  cloud->reserve(kRings * kColumns);
  for (int c = 0; c < kColumns; ++c) {
    const double azimuth = 2 * M_PI * c / kColumns;
    for (int r = 0; r < kRings; ++r) {
      const double elevation = (-15.0 + 2.0 * r) * M_PI / 180.0;
      const Eigen::Vector3d d(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const Hit hit = cast(boxes, X_map_lidar.translation(), X_map_lidar.linear() * d);
      if (hit.range > kMaxRange_m || hit.range < 0.5) continue;
      const Eigen::Vector3d p = d * (hit.range + noise(random));
      cloud->push(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                  30, static_cast<std::uint8_t>(r), static_cast<float>(0.1 * c / kColumns));
    }
  }
  return cloud;
}

ThermalImagePtr makeFakeThermal(const FakeRobot& robot, std::uint64_t seq) {
  auto image = std::make_shared<ThermalImage>();
  image->stamp = robot.now();
  image->seq = seq;
  image->frame_counter = static_cast<std::uint32_t>(seq);
  image->counts.resize(static_cast<std::size_t>(image->width) * image->height);
  const FakeRobot::HotSpot spot = robot.hotSpot();
  std::mt19937_64 random(seq * 7919);
  std::normal_distribution<double> noise(0.0, 0.05);
  const auto blob = [](double u, double v, double cu, double cv, double r) {
    const double d = std::hypot(u - cu, v - cv) / r;
    return std::exp(-d * d * d * d);
  };
  for (int v = 0; v < image->height; ++v) {
    for (int u = 0; u < image->width; ++u) {
      double c = 22.0 + 2.5 * (1.0 - v / 119.0) + 0.8 * std::sin(u * 0.05);
      if (spot.u >= 0) {
        c += (spot.peak_c - 24.0) * blob(u, v, spot.u, spot.v, 11.0);
        c += 33.0 *
             blob(u, v, spot.u - 42.0, spot.v + 26.0, 9.0);  // the plate mirrored in the acrylic
      }
      const double kelvin = c + kKelvin + noise(random);
      image->counts[static_cast<std::size_t>(v) * image->width + u] =
          static_cast<std::uint16_t>(kelvin * 100.0);
    }
  }
  return image;
}

HeatDetections makeFakeHeat(const FakeRobot& robot, const ThermalImage& image) {
  HeatDetections heat;
  heat.stamp = image.stamp;
  heat.image_seq = image.seq;
  heat.threshold_k = kThreshold_c + kKelvin;
  heat.max_k = *std::max_element(image.counts.begin(), image.counts.end()) * image.kelvin_per_count;
  const FakeRobot::HotSpot spot = robot.hotSpot();
  if (spot.u < 0) return heat;
  HeatBlob blob;
  blob.u = spot.u;
  blob.v = spot.v;
  blob.u_min = static_cast<int>(std::max(0.0, spot.u - 12));
  blob.v_min = static_cast<int>(std::max(0.0, spot.v - 12));
  blob.u_max = static_cast<int>(std::min(159.0, spot.u + 12));
  blob.v_max = static_cast<int>(std::min(119.0, spot.v + 12));
  blob.peak_k = spot.peak_c + kKelvin;
  blob.background_k = 24 + kKelvin;
  blob.half_max_area_px = 420;
  if (spot.peak_c < kThreshold_c) {
    blob.rejection = HeatRejection::TooCool;
    blob.reason =
        fmt::format("{:.0f} °C is below the threshold of {:.0f} °C", spot.peak_c, kThreshold_c);
  }
  heat.blobs.push_back(blob);
  HeatBlob mirror = blob;
  mirror.u -= 42;
  mirror.v += 26;
  mirror.u_min = static_cast<int>(std::clamp(mirror.u - 9, 0.0, 159.0));
  mirror.u_max = static_cast<int>(std::clamp(mirror.u + 9, 0.0, 159.0));
  mirror.v_min = static_cast<int>(std::clamp(mirror.v - 9, 0.0, 119.0));
  mirror.v_max = static_cast<int>(std::clamp(mirror.v + 9, 0.0, 119.0));
  mirror.peak_k = 57 + kKelvin;
  mirror.rejection = HeatRejection::Reflection;
  mirror.reason = "moves against the parallax of the box: a reflection in the acrylic";
  heat.blobs.push_back(mirror);
  return heat;
}

RgbImagePtr makeFakeCamera(const FakeRobot& robot, std::uint64_t seq) {
  auto image = std::make_shared<RgbImage>();
  image->stamp = robot.now();
  image->seq = seq;
  image->frame = frames::kOperatorCamera;
  image->width = 320;
  image->height = 180;
  image->data.resize(static_cast<std::size_t>(3 * image->width * image->height));
  const std::vector<SceneBox> boxes = makeFakeArena();
  const Eigen::Isometry3d X_map_camera =
      toIsometry(robot.pose()) * robot.geometry().X_base_operatorcamera.pose();
  const CameraModel camera = CameraModel::fromHorizontalFov(image->width, image->height, 1.57);
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, 0.3, 0.85).normalized();
  std::size_t at = 0;
  for (int v = 0; v < image->height; ++v) {
    for (int u = 0; u < image->width; ++u) {
      const Eigen::Vector3d d = X_map_camera.linear() * camera.ray({u, v});
      const Hit hit = cast(boxes, X_map_camera.translation(), d);
      double shade = 0.35 + 0.65 * std::max(0.0, hit.normal.dot(light));
      std::uint32_t rgb = hit.rgb;
      if (!std::isfinite(hit.range)) {
        rgb = 0xb9c7d3;
        shade = 1.0;
      }
      for (int shift = 16; shift >= 0; shift -= 8) {
        image->data[at++] = static_cast<std::uint8_t>(((rgb >> shift) & 0xffU) * shade);
      }
    }
  }
  return image;
}

}  // namespace kiln::gui
