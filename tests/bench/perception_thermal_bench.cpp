// Cost of the thermal path on one core. The figures stand in resources/docs/benchmarks.md.
#include <benchmark/benchmark.h>

#include "robot/perception/thermal/heat_detector.h"
#include "robot/perception/thermal/heat_localizer.h"
#include "tests/support/thermal_renderer.h"

namespace kiln {
namespace {

testing::ThermalScene kitchen() {
  testing::ThermalScene scene;
  scene.X_map_plate.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  scene.discs = {{{0.2, 0.6, 0.1}, 0.15, 330}, {{0.1, -0.5, 0.3}, 0.2, 318}};
  return scene;
}

std::vector<ThermalImage> frames(const testing::ThermalScene& scene,
                                 std::vector<Eigen::Isometry3d>& poses) {
  testing::ThermalRenderer renderer({}, 1);
  std::vector<ThermalImage> out;
  for (int i = 0; i < 40; ++i) {
    const double phase = 2 * M_PI * i / 40;
    poses.push_back(
        testing::lookAt({0.9, 0.15 * std::sin(phase), 0.05}, {0, 0.1 * std::cos(phase), 0}));
    out.push_back(renderer.render(scene, poses.back()));
  }
  return out;
}

void detectFrame(benchmark::State& state) {
  testing::ThermalScene scene = kitchen();
  if (state.range(0) == 0) {
    scene.plate_k = scene.ambient_k;
    scene.discs.clear();
  }
  std::vector<Eigen::Isometry3d> poses;
  auto images = frames(scene, poses);
  HeatDetector detector({});
  std::uint32_t counter = 0;
  for (auto _ : state) {
    ThermalImage& image = images[counter % images.size()];
    image.frame_counter = ++counter;
    benchmark::DoNotOptimize(detector.detect(image));
  }
}
BENCHMARK(detectFrame)->ArgName("warm")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void localizeSweep(benchmark::State& state) {
  const testing::ThermalScene scene = kitchen();
  std::vector<Eigen::Isometry3d> poses;
  const auto images = frames(scene, poses);
  HeatDetector detector({});
  std::vector<HeatDetections> found;
  for (const auto& image : images) found.push_back(detector.detect(image));
  for (auto _ : state) {
    HeatLocalizer localizer({});
    for (std::size_t i = 0; i < found.size(); ++i)
      localizer.add(found[i], poses[i], Eigen::Vector3d::UnitX());
    benchmark::DoNotOptimize(localizer.estimate());
  }
}
BENCHMARK(localizeSweep)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
