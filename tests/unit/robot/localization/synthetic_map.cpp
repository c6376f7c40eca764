#include "tests/unit/robot/localization/synthetic_map.h"

#include <cmath>
#include <random>

#include "common/core/units.h"
#include "robot/scene/fire_site_map.h"

namespace kiln::testing {
namespace {

std::vector<Pose2> along(const std::vector<Eigen::Vector2d>& corners, double step_m) {
  std::vector<Pose2> out;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d d = corners[i] - corners[i - 1];
    const int n = static_cast<int>(std::ceil(d.norm() / step_m));
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector2d p = corners[i - 1] + d * k / n;
      out.push_back({p.x(), p.y(), std::atan2(d.y(), d.x())});
    }
  }
  return out;
}

/// What returns rays, apart from the floor.
std::vector<BoxConfig> kitchenBoxes(double furniture_m, double boxes_m, std::uint32_t seed) {
  const ArenaMap arena = kitchen();
  std::vector<BoxConfig> boxes = arena.walls;
  for (const auto& box : moved(arena.furniture, furniture_m, seed)) boxes.push_back(box);
  for (const auto& box : moved(arena.fixtures.at(kFireSite).boxes, boxes_m, seed + 100))
    boxes.push_back(box);
  return boxes;
}

}  // namespace

SurfelMap::ScanId insertScan(SurfelMap& map, const PointCloud& scan,
                             const Eigen::Isometry3d& X_map_base,
                             const Eigen::Vector3d& p_base_sensor) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    points.push_back((X_map_base * Eigen::Vector3f(scan.x[i], scan.y[i], scan.z[i]).cast<double>())
                         .cast<float>());
  }
  return map.insert(points, X_map_base * p_base_sensor);
}

std::vector<Pose2> roundTrip() {
  return along({{6.4, 0},
                {8.6, 1.6},
                {9.9, 2.8},
                {9.0, 3.6},
                {7.4, 2.0},
                {7.2, -1.0},
                {7.4, -3.6},
                {10.6, -2.4},
                {11.8, 0.2},
                {9.6, -0.6},
                {6.4, 0}},
               0.4);
}

std::vector<Pose2> approach() { return along({{0, 0}, {2.5, 0}, {7.0, 0}}, 0.4); }

std::vector<MapScan> mapScans(const std::vector<Pose2>& poses) {
  ScanSettings settings;
  settings.boxes = kitchenBoxes(0.0, 0.0, 1);
  settings.seed = 4711;
  std::mt19937 random(4712);
  std::normal_distribution<double> normal;
  const auto normal3 = [&] {
    return Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  std::vector<MapScan> out;
  for (const Pose2& pose : poses) {
    const Eigen::Isometry3d X = toIsometry(pose);
    out.push_back(
        {castScan(settings, X), X * makePose(0.005 * normal3(), 0.05 * kDeg * normal3())});
  }
  return out;
}

std::shared_ptr<const SurfelMap> mapOf(const std::vector<MapScan>& scans,
                                       const Eigen::Vector3d& p_map_center) {
  auto map = std::make_shared<SurfelMap>(SurfelMap::Config{}, p_map_center);
  PostCollector posts;
  for (const MapScan& scan : scans) {
    const Eigen::Vector3d p_base_sensor = ScanSettings{}.p_base_sensor;
    insertScan(*map, scan.scan_base, scan.X_map_base, p_base_sensor);
    posts.add(findEdges(scan.scan_base, p_base_sensor, 2000), scan.X_map_base);
  }
  map->setPosts(posts.posts());
  map->forgetScans();
  map->refresh();
  return map;
}

MatchCase caseAt(const Pose2& where, const CaseSettings& settings, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto uniform3 = [&] { return Eigen::Vector3d(unit(random), unit(random), unit(random)); };
  const auto normal3 = [&] {
    return Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  ScanSettings scan;
  scan.boxes = kitchenBoxes(0.15, 0.10, seed);
  scan.seed = seed;
  scan.directions = settings.directions;
  scan.random_return_fraction = 0.03;
  scan.X_sensor_truesensor =
      makePose(settings.extrinsic_m * normal3(), settings.extrinsic_deg * kDeg * normal3());
  for (int i = 0; i < settings.people; ++i) {
    const double bearing = M_PI * unit(random), range = 2.5 + unit(random);
    scan.boxes.push_back(makeBox(where.x_m + 0.5 + range * std::cos(bearing),
                                 where.y_m + range * std::sin(bearing), 0.88, 0.4, 0.3, 1.76));
  }
  if (settings.half_blocked) {  // a crowd beside the robot, from ahead to behind
    const Eigen::Isometry3d X = toIsometry(where);
    const Eigen::Vector3d p = X * Eigen::Vector3d(0.5, 1.6 * (unit(random) > 0 ? 1 : -1), 1.2);
    BoxConfig crowd = makeBox(p.x(), p.y(), p.z(), 16.0, 0.4, 2.4);
    crowd.center.rpy_deg[2] = where.yaw_rad / kDeg;
    scan.boxes.push_back(crowd);
  }
  MatchCase out;
  const Eigen::Vector3d tilt =
      settings.tilt_deg * kDeg * uniform3().cwiseProduct(Eigen::Vector3d(1, 1, 0));
  out.X_map_base = toIsometry(where) * makePose({0, 0, 0}, tilt);
  out.scan = castScan(scan, out.X_map_base);
  out.prior = toIsometry({where.x_m + settings.prior_m * unit(random),
                          where.y_m + settings.prior_m * unit(random),
                          where.yaw_rad + settings.prior_deg * kDeg * unit(random)}) *
              makePose({0, 0, 0.02 * unit(random)}, 0.75 * tilt);
  return out;
}

Pose2 somewhereInside(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(6.4, 11.2), y(-3.4, 3.6), yaw(-M_PI, M_PI);
  return {x(random), y(random), yaw(random)};
}

}  // namespace kiln::testing
