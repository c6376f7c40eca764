#include <benchmark/benchmark.h>

#include "robot/localization/box_map_aligner.h"
#include "tests/unit/robot/localization/synthetic_scan.h"

namespace kiln {
namespace {

/// A scan as dense as the VLP-16's: 16 lasers, 1800 directions.
struct Scene {
  ArenaMap arena = testing::kitchen();
  BoxMapAligner aligner{{}, arena};
  testing::ScanSettings settings;
  Scene() {
    settings.boxes = arena.walls;
    for (const auto& box : testing::moved(arena.furniture, 0.15, 3)) settings.boxes.push_back(box);
    settings.directions = 1800;
  }
};

void BM_AlignInsideKitchen(benchmark::State& state) {
  const Scene scene;
  const auto scan = testing::castScan(scene.settings, {9.0, 0.5, 0.3});
  for (auto _ : state) {
    auto found = scene.aligner.align(scan, scene.settings.p_base_sensor, {9.05, 0.47, 0.31});
    benchmark::DoNotOptimize(found);
  }
  state.counters["points"] = static_cast<double>(scan.size());
}
BENCHMARK(BM_AlignInsideKitchen)->Unit(benchmark::kMillisecond);

void BM_AlignAtTheStart(benchmark::State& state) {
  const Scene scene;
  const auto scan = testing::castScan(scene.settings, {0.1, -0.1, 0.02});
  for (auto _ : state) {
    auto found = scene.aligner.align(scan, scene.settings.p_base_sensor, {0.0, 0.0, 0.0});
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(BM_AlignAtTheStart)->Unit(benchmark::kMillisecond);

void BM_SearchAtTheStart(benchmark::State& state) {
  const Scene scene;
  const auto scan = testing::castScan(scene.settings, {0.2, -0.2, 0.08});
  for (auto _ : state) {
    auto found = scene.aligner.search(scan, scene.settings.p_base_sensor, {0.0, 0.0, 0.0});
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(BM_SearchAtTheStart)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
