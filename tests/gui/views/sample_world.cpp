#include "tests/gui/views/sample_world.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "common/geom/frames.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "tests/support/kitchen.h"

namespace kiln::gui {
namespace {

template <class T>
T load(const char* name) {
  T value;
  const auto path = resourcePath(name);
  const Result<void> loaded =
      path ? loadConfig(*path, value) : Result<void>(tl::make_unexpected(path.error()));
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    std::abort();
  }
  return value;
}

SceneBox toSceneBox(const BoxConfig& box) {
  const auto& s = box.size_m;
  return {box.name, box.center.pose(), 0.5 * Eigen::Vector3d(s[0], s[1], s[2])};
}

/// Distance along a unit ray to a box, or infinity.
double hit(const SceneBox& box, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  const Eigen::Isometry3d X_box_map = box.X_map_box.inverse();
  const Eigen::Vector3d o = X_box_map * from, d = X_box_map.linear() * direction;
  double near = 0.0, far = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const double a = (-box.half_extent[k] - o[k]) / d[k], b = (box.half_extent[k] - o[k]) / d[k];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near < far && near > 0.0 ? near : INFINITY;
}

}  // namespace

SampleWorld::SampleWorld()
    : robot_(load<RobotGeometry>("robot_model/bob.yaml")),
      arena_(loadKitchen()),
      site_(loadKitchenSite()) {
  for (const BoxConfig& box : arena_.walls) boxes_.push_back(toSceneBox(box));
  for (const BoxConfig& box : arena_.furniture) boxes_.push_back(toSceneBox(box));
  for (const BoxConfig& box : site_.fixtures().boxes) boxes_.push_back(toSceneBox(box));
}

RobotStatus SampleWorld::status(Stamp stamp, double t_s) const {
  RobotStatus s;
  s.stamp = stamp;
  s.mode = Mode::Supervised;
  s.word = StatusWord::Supervised;
  const Pose2 work = site_.places.front().work_pose.pose();
  const double ahead = std::max(0.0, 1.0 - 0.2 * t_s);
  s.X_map_base = {work.x_m - 2.0 * ahead, work.y_m - 1.2 * ahead, 0.5 * ahead};
  s.arm.q << M_PI, -1.9 + 0.1 * std::sin(t_s), 1.7, -1.4, 90 * kDeg, M_PI;
  s.wheel_steer_rad = {0.5 * ahead, 0.5 * ahead, -0.3 * ahead, -0.3 * ahead};
  s.figures = fire::figures(water(), 4.2, 273.15 + 127.0);
  return s;
}

WaterLevels SampleWorld::water() const {
  WaterLevels levels;
  levels.tank_l_est = {3.4, 3.8};
  levels.sprayed_l_est = 2.84;
  return levels;
}

MissionInfo SampleWorld::mission() const {
  MissionInfo info = fire::missionInfo(0.5, 30.0);
  info.mission = "fire";
  info.actuators = {{kPumps, "Both pumps"}};
  return info;
}

PointCloudPtr SampleWorld::cloud(const RobotStatus& status, int columns) const {
  auto out = std::make_shared<PointCloud>();
  out->stamp = status.stamp;
  out->frame = frames::kMap;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.012);
  const Eigen::Isometry3d X_map_base = toIsometry(status.X_map_base);
  const Eigen::Vector3d eye = X_map_base * Eigen::Vector3d(0.4, 0.0, 1.5);
  for (int ring = 0; ring < 16; ++ring) {
    const double elevation = (-15.0 + 2.0 * ring) * kDeg;
    for (int i = 0; i < columns; ++i) {
      const double azimuth = 2.0 * M_PI * i / columns;
      const Eigen::Vector3d d(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      double range = d.z() < 0 ? -eye.z() / d.z() : INFINITY;
      for (const SceneBox& box : boxes_) range = std::min(range, hit(box, eye, d));
      if (range > 40.0) continue;
      const Eigen::Vector3d p = eye + (range + noise(random)) * d;
      out->push(float(p.x()), float(p.y()), float(p.z()), 20, static_cast<std::uint8_t>(ring),
                0.0F);
    }
  }
  return out;
}

Scene SampleWorld::scene(Stamp stamp, const RobotStatus& status, bool spraying) const {
  Scene s;
  s.stamp = stamp;
  s.arena = boxes_;
  FireSite site;
  site.stamp = stamp;
  site.footprint_m = {robot_.length_m, robot_.width_m};
  for (const FirePlaceConfig& place : site_.places) {
    const auto& p = place.plate_xyz_m;
    site.places.push_back({place.name,
                           {p[0], p[1], p[2]},
                           place.facing_deg * kDeg,
                           false,
                           {},
                           place.work_pose.pose()});
  }
  for (const GroundPoseConfig& pose : arena_.entry_path)
    s.planned.waypoints_map.push_back(pose.pose());
  for (const GroundPoseConfig& pose : site_.places[0].via)
    s.planned.waypoints_map.push_back(pose.pose());
  s.planned.waypoints_map.push_back(site_.places[0].work_pose.pose());
  s.planned.next = 3;
  FireEstimate fire;
  fire.stamp = stamp;
  fire.place = site.places[0].name;
  fire.p_map = site.places[0].p_map + Eigen::Vector3d(0.03, -0.04, 0.01);
  fire.covariance = Eigen::Vector3d(1e-4, 2.5e-5, 2.5e-5).asDiagonal();
  fire.views = 31;
  fire.peak_k = 273.15 + 127.0;
  fire.range_m = 0.86;
  site.fires.push_back(fire);
  const Eigen::Vector3d exit = toIsometry(status.X_map_base) * robot_.X_base_flange(status.arm.q) *
                               robot_.X_flange_nozzle.pose().translation();
  const Eigen::Vector3d level(fire.p_map.x() - exit.x(), fire.p_map.y() - exit.y(), 0.0);
  const double flight_s = level.norm() / 6.0;
  for (int i = 0; i <= 20; ++i) {
    const double t = flight_s * i / 20.0;
    const double up = (fire.p_map.z() - exit.z()) / flight_s + 0.5 * 9.81 * flight_s;
    site.jet_map.push_back(exit + level * (t / flight_s) +
                           Eigen::Vector3d(0, 0, up * t - 0.5 * 9.81 * t * t));
  }
  site.spraying = spraying;
  s.items = fire::sceneItems(site);
  s.detail = wire::encodeDetail(site);
  return s;
}

ThermalImagePtr SampleWorld::thermal(Stamp stamp, std::uint32_t counter) const {
  auto image = std::make_shared<ThermalImage>();
  image->stamp = stamp;
  image->seq = counter;
  image->frame_counter = counter;
  image->counts.resize(160 * 120);
  std::mt19937 random(counter);
  std::normal_distribution<double> noise(0.0, 0.15);
  const auto blob = [](double u, double v, double cu, double cv, double size, double peak) {
    return peak / (1.0 + std::exp((std::hypot(u - cu, v - cv) - size) / 1.6));
  };
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      double celsius = 26.0 + 3.0 * std::sin(u * 0.03) + 0.02 * v + noise(random);
      celsius += blob(u, v, 98, 56, 10.0, 100.0) + blob(u, v, 34, 94, 8.0, 29.0) +
                 blob(u, v, 133, 90, 4.0, 24.0);
      image->counts[static_cast<std::size_t>(v * 160 + u)] =
          static_cast<std::uint16_t>(std::lround((celsius + 273.15) / image->kelvin_per_count));
    }
  }
  return image;
}

HeatDetections SampleWorld::heat(const ThermalImage& image) const {
  HeatDetections out;
  out.stamp = image.stamp;
  out.image_seq = image.seq;
  out.threshold_k = 273.15 + 75.0;
  out.max_k = 273.15 + 127.0;
  out.blobs.push_back(
      {98, 56, 86, 44, 110, 68, 273.15 + 127.0, 300.0, 310, HeatRejection::None, ""});
  out.blobs.push_back({34, 94, 25, 85, 43, 103, 273.15 + 56.0, 300.0, 200, HeatRejection::TooCool,
                       "56 °C is below the threshold of 75 °C"});
  out.blobs.push_back({133, 90, 129, 86, 137, 94, 273.15 + 51.0, 300.0, 60,
                       HeatRejection::Reflection, "mirrors the hot plate in the acrylic"});
  return out;
}

RgbImagePtr SampleWorld::picture(Stamp stamp, std::uint64_t seq) const {
  auto image = std::make_shared<RgbImage>();
  image->stamp = stamp;
  image->seq = seq;
  image->frame = frames::kOperatorCamera;
  image->width = 640;
  image->height = 360;
  image->data.resize(640 * 360 * 3);
  for (int y = 0; y < 360; ++y) {
    for (int x = 0; x < 640; ++x) {
      auto* p = image->data.data() + 3 * (y * 640 + x);
      const bool deck = y > 250 && std::abs(x - 320) < (y - 150) * 2;
      const bool tile =
          y > 160 && (((x - 320) * 40 / (y - 150) / 20 + 100 + 900 / (y - 150)) % 2 == 0);
      const int base = deck ? 92 : y > 160 ? (tile ? 120 : 108) : 165 - y / 4;
      p[0] = static_cast<std::uint8_t>(base + (deck ? 6 : 8));
      p[1] = static_cast<std::uint8_t>(base + 4);
      p[2] = static_cast<std::uint8_t>(base);
    }
  }
  return image;
}

std::vector<MacroInfo> SampleWorld::macros() const {
  return {{"spray fire 1", "sprays at the configured first place", 18.0, "start within 5 cm",
           "est. 0.9 l"},
          {"spray fire 2", "sprays at the configured second place", 18.0, "start within 5 cm",
           "est. 0.9 l"},
          {"arm park", "folds the arm above the deck", 6.0, "", ""}};
}

}  // namespace kiln::gui
