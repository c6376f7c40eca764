// The same scans and the same map points for our scan matcher, PCL's GICP and PCL's NDT: errors and
// time (resources/docs/benchmarks.md). First argument: 0 = calibrated LiDAR, 1 = extrinsics off by
// N(0, 5 mm, 0.3 deg). Second one of NDT: cell in cm.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>

#include <benchmark/benchmark.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/ndt.h>

#include "common/core/units.h"
#include "robot/localization/scan_matcher.h"
#include "tests/unit/robot/localization/synthetic_map.h"

namespace kiln {
namespace {

constexpr std::uint32_t kCases = 60;
const Eigen::Vector3d kSensor = testing::ScanSettings{}.p_base_sensor;

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

PclCloud::Ptr toPcl(const PointCloud& cloud, const Eigen::Isometry3d& X_target_cloud) {
  PclCloud::Ptr out(new PclCloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p =
        (X_target_cloud * Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]).cast<double>())
            .cast<float>();
    out->push_back({p.x(), p.y(), p.z()});
  }
  return out;
}

PclCloud::Ptr thinned(const PclCloud::Ptr& cloud, float leaf_m) {
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf_m, leaf_m, leaf_m);
  PclCloud::Ptr out(new PclCloud);
  grid.filter(*out);
  return out;
}

/// Map and cases, made once.
struct Setup {
  std::vector<testing::MapScan> scans = testing::mapScans(testing::roundTrip());
  std::shared_ptr<const SurfelMap> map = testing::mapOf(scans, {10.0, 0.0, 0.8});
  PclCloud::Ptr points{new PclCloud};
  std::array<std::vector<testing::MatchCase>, 2> cases;  ///< calibrated LiDAR, and not

  Setup() {
    for (const auto& scan : scans) *points += *toPcl(scan.scan_base, scan.X_map_base);
    points = thinned(points, 0.05F);
    for (std::uint32_t seed = 1; seed <= kCases; ++seed) {
      testing::CaseSettings settings;
      settings.half_blocked = seed % 4 == 0;
      settings.tilt_deg = seed % 3 == 0 ? 2.0 : 0.0;
      const Pose2 where = testing::somewhereInside(seed);
      cases[1].push_back(testing::caseAt(where, settings, seed));
      settings.extrinsic_m = settings.extrinsic_deg = 0.0;
      cases[0].push_back(testing::caseAt(where, settings, seed));
    }
  }
  static const Setup& get() {
    static const Setup setup;
    return setup;
  }
};

using Method = std::function<std::optional<Eigen::Isometry3d>(const testing::MatchCase&)>;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return -1.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void run(benchmark::State& state, const Method& method) {
  const Setup& setup = Setup::get();
  std::vector<double> position, yaw, time;
  int failures = 0;
  for (auto _ : state) {
    for (const auto& match_case : setup.cases.at(static_cast<std::size_t>(state.range(0)))) {
      const auto before = std::chrono::steady_clock::now();
      const auto found = method(match_case);
      time.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before)
              .count());
      if (!found) {
        ++failures;
        continue;
      }
      const Eigen::Isometry3d error = match_case.X_map_base.inverse() * *found;
      position.push_back(1000.0 * error.translation().head<2>().norm());
      yaw.push_back(std::abs(projectToGround(error).yaw_rad) / kDeg);
    }
  }
  state.counters["pos_med_mm"] = quantile(position, 0.5);
  state.counters["pos_p95_mm"] = quantile(position, 0.95);
  state.counters["yaw_med_deg"] = quantile(yaw, 0.5);
  state.counters["yaw_p95_deg"] = quantile(yaw, 0.95);
  state.counters["scan_med_ms"] = quantile(time, 0.5);
  state.counters["scan_p99_ms"] = quantile(time, 0.99);
  state.counters["failed"] = failures;
}

void BM_Kiln(benchmark::State& state) {
  const ScanMatcher matcher({}, Setup::get().map);
  run(state, [&](const testing::MatchCase& c) -> std::optional<Eigen::Isometry3d> {
    const auto match = matcher.match(c.scan, c.prior, kSensor);
    if (!match) return std::nullopt;
    return match->X_map_base;
  });
}
BENCHMARK(BM_Kiln)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kMillisecond);

template <class Registration>
std::optional<Eigen::Isometry3d> align(Registration& registration, const testing::MatchCase& c,
                                       float leaf_m) {
  registration.setInputSource(thinned(toPcl(c.scan, Eigen::Isometry3d::Identity()), leaf_m));
  PclCloud aligned;
  registration.align(aligned, c.prior.matrix().cast<float>());
  if (!registration.hasConverged()) return std::nullopt;
  return Eigen::Isometry3d(registration.getFinalTransformation().template cast<double>());
}

void BM_PclGicp(benchmark::State& state) {
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
  gicp.setInputTarget(Setup::get().points);
  gicp.setMaxCorrespondenceDistance(0.3);
  gicp.setMaximumIterations(30);
  gicp.setTransformationEpsilon(5e-4);
  run(state, [&](const testing::MatchCase& c) { return align(gicp, c, 0.2F); });
}
BENCHMARK(BM_PclGicp)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kMillisecond);

void BM_PclNdt(benchmark::State& state) {
  pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> ndt;
  ndt.setResolution(static_cast<float>(state.range(1)) / 100.0F);
  ndt.setInputTarget(Setup::get().points);
  ndt.setStepSize(0.1);
  ndt.setTransformationEpsilon(1e-3);
  ndt.setMaximumIterations(30);
  run(state, [&](const testing::MatchCase& c) { return align(ndt, c, 0.2F); });
}
BENCHMARK(BM_PclNdt)->Args({0, 50})->Args({0, 100})->Args({1, 50})->Iterations(1)->Unit(
    benchmark::kMillisecond);

/// Wrong start poses up to 1 m and 20 deg.
void BM_KilnSearch(benchmark::State& state) {
  const Setup& setup = Setup::get();
  const ScanMatcher matcher({}, setup.map);
  std::vector<double> time;
  int recovered = 0, refused = 0, wrong = 0;
  for (auto _ : state) {
    for (std::uint32_t seed = 1001; seed <= 1200; ++seed) {
      testing::CaseSettings settings;
      settings.prior_m = 0.7;
      settings.prior_deg = 20.0;
      settings.directions = 900;
      const auto c = testing::caseAt(testing::somewhereInside(seed), settings, seed);
      const auto before = std::chrono::steady_clock::now();
      const auto match = matcher.search(c.scan, c.prior, kSensor);
      time.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before)
              .count());
      if (!match) {
        ++refused;
        continue;
      }
      const Eigen::Isometry3d error = c.X_map_base.inverse() * match->X_map_base;
      const bool right =
          error.translation().head<2>().norm() < 0.1 && rotationAngle(error) < 2.0 * kDeg;
      ++(right ? recovered : wrong);
    }
  }
  state.counters["recovered"] = recovered;
  state.counters["refused"] = refused;
  state.counters["wrong"] = wrong;
  state.counters["search_med_ms"] = quantile(time, 0.5);
  state.counters["search_p99_ms"] = quantile(time, 0.99);
}
BENCHMARK(BM_KilnSearch)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
