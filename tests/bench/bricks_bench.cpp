// Cost of the brick perception on one core: model cloud against the paper's render of 2800 x 2800
// pixels, and the pipeline from a sweep of 4.5 s to the poses of 20 bricks.
#include <benchmark/benchmark.h>

#include "robot/evaluation/bricks/brick_trial.h"
#include "robot/evaluation/bricks/processor_clock.h"
#include "robot/perception/bricks/brick_perception.h"
#include "tests/unit/robot/perception/bricks/render_cloud.h"

namespace kiln {
namespace {

/// As pose estimation uses it: faces on a lattice of 2 cm.
void modelCloud(benchmark::State& state) {
  ModelWorld world = pileSeenFromAhead();
  ModelCloudGenerator generator({});
  for (auto _ : state) {
    world.sensors[0].x() += 1e-6;
    benchmark::DoNotOptimize(generator.generate(world));
  }
}
BENCHMARK(modelCloud)->Unit(benchmark::kMillisecond);

/// What the unit test ModelCloud.EqualsTheRender compares: 1 cm, thinned to 2 cm.
void modelCloudThinned(benchmark::State& state) {
  const ModelWorld world = pileSeenFromAhead();
  ModelCloudGenerator generator({0.01, 0.05});
  for (auto _ : state) benchmark::DoNotOptimize(voxelised(generator.generate(world).points, 0.02));
}
BENCHMARK(modelCloudThinned)->Unit(benchmark::kMillisecond);

void render2800Thinned(benchmark::State& state) {
  const ModelWorld world = pileSeenFromAhead();
  for (auto _ : state) benchmark::DoNotOptimize(voxelised(renderCloud(world, 2800), 0.02));
}
BENCHMARK(render2800Thinned)->Unit(benchmark::kMillisecond);

void prepare(benchmark::State& state) {
  const BrickTrial trial = makeTrial({}, 1);
  const SweepRegion region = RoughPoseEstimator::region(trial.target, 0.6);
  for (auto _ : state) benchmark::DoNotOptimize(prepareSweep(trial.sweep, region, {}));
}
BENCHMARK(prepare)->Unit(benchmark::kMillisecond);

void roughPose(benchmark::State& state) {
  const BrickTrial trial = makeTrial({}, 1);
  const auto sweep = prepareSweep(trial.sweep, RoughPoseEstimator::region(trial.target, 0.6), {});
  RoughPoseEstimator estimator({});
  for (auto _ : state) benchmark::DoNotOptimize(estimator.estimate(*sweep, trial.target));
}
BENCHMARK(roughPose)->Unit(benchmark::kMillisecond);

/// @param state  0: ours, 1: the paper's method. Counters: an outer iteration, its solve, ms.
void pipeline(benchmark::State& state) {
  const BrickTrial trial = makeTrial({}, 1);
  const ProcessorClock clock;
  BrickPerception::Config config;
  if (state.range(0) == 1) config.bricks = BrickPoseEstimator::Config::paper();
  BrickPerception perception(config, &clock);
  double iteration_ms = 0.0, solve_ms = 0.0, count = 0.0;
  for (auto _ : state) {
    const auto sight = perception.perceive(trial.sweep, trial.target);
    if (!sight) {
      state.SkipWithError(sight.error().message.c_str());
      break;
    }
    iteration_ms += sight->bricks.iteration_ms;
    solve_ms += sight->bricks.solve_ms;
    count += 1.0;
  }
  state.counters["iteration_ms"] = iteration_ms / count;
  state.counters["solve_ms"] = solve_ms / count;
}
BENCHMARK(pipeline)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
