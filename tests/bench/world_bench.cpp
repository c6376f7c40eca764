// Speed of the world alone, without a robot's programs: simulated seconds a second of one core
// (`real_time_factor`), after its bricks have come to rest.
#include <benchmark/benchmark.h>

#include "common/config/resources.h"
#include "robot/sim/world.h"

namespace kiln::sim {
namespace {

constexpr double kSlice_s = 0.5;

void run(benchmark::State& state, const char* name, bool freeze, bool lidar) {
  WorldConfig config = *WorldConfig::load(*resourcePath(std::string("worlds/") + name + ".yaml"));
  config.wall.freeze = freeze;
  auto world = std::move(*World::create(config, 1));
  (void)world->advance(world->now() + fromSeconds(2.0));
  if (lidar) {
    WorldCommands commands;
    commands.sensors = SensorRequest{.lidar = true};
    world->command(commands);
  }
  double simulated_s = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(world->advance(world->now() + fromSeconds(kSlice_s)));
    simulated_s += kSlice_s;
  }
  state.counters["real_time_factor"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
  state.counters["awake"] = static_cast<double>(world->awakeBricks());
}

BENCHMARK_CAPTURE(run, wall_45_bricks, "wall", true, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, wall_45_bricks_all_awake, "wall", false, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, wall_45_bricks_lidar, "wall", true, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, wall_lab_11_bricks, "wall_lab", true, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, fire, "fire", true, false)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln::sim
