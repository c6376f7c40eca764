#include <benchmark/benchmark.h>

#include "common/config/resources.h"
#include "robot/evaluation/marker/marker_trial.h"

namespace kiln {
namespace {

/// One look at the marker, painted once for all benchmarks.
const std::vector<MarkerTrial::Step>& steps() {
  static const std::vector<MarkerTrial::Step> all = [] {
    std::vector<MarkerTrial::Step> out;
    const auto robot = loadResource<RobotGeometry>("robot_model/bob.yaml");
    if (!robot) std::abort();
    MarkerTrial trial(drawYard(MarkerCase::Whole, 7.0, 2), *robot, 2);
    for (int i = 0; i < 12; ++i) out.push_back(trial.at(i / 11.0));
    return out;
  }();
  return all;
}

void detectPicture(benchmark::State& state) {
  const MarkerDetector detector({});
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(detector.detect(steps()[i++ % steps().size()].image));
}
BENCHMARK(detectPicture)->Unit(benchmark::kMillisecond);

void groundOfScan(benchmark::State& state) {
  const MarkerTrial::Step& step = steps().front();
  for (auto _ : state)
    benchmark::DoNotOptimize(fitGroundPlane(step.scan_base, {7.0, 0.0}, GroundPlaneConfig{}));
}
BENCHMARK(groundOfScan)->Unit(benchmark::kMillisecond);

void searchWindow(benchmark::State& state) {
  MarkerLocalizer::Config config;
  config.refine = state.range(0) != 0;
  MarkerLocalizer localizer(config);
  const MarkerDetector detector({});
  // As many pictures as 10 s at 10 Hz have.
  for (int k = 0; k < 100; ++k) {
    const MarkerTrial::Step& step = steps()[static_cast<std::size_t>(k) * steps().size() / 100];
    MarkerView view = detector.detect(step.image);
    view.stamp = stampFromNanoseconds(0) + fromSeconds(0.1 * k);
    localizer.add(view, step.from);
  }
  for (auto _ : state) benchmark::DoNotOptimize(localizer.search());
}
BENCHMARK(searchWindow)->ArgName("refine")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
