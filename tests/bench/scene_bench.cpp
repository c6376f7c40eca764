// Frames a second of the 3D scene with 30,000 and 60,000 points: a new cloud and a moved camera for
// every frame, as while driving. Run under Xvfb with LP_NUM_THREADS=1 for the figure of the issue:
//   LP_NUM_THREADS=1 xvfb-run -a build/bench/scene_bench
#include <benchmark/benchmark.h>

#include "gui/views/scene3d/scene_renderer.h"
#include "tests/gui/views/qt_app.h"
#include "tests/gui/views/sample_world.h"

namespace kiln::gui {
namespace {

/// All rays of the sweep that hit something, thinned or repeated to exactly `points`.
PointCloudPtr cloudOf(const SampleWorld& world, const RobotStatus& robot, std::size_t points) {
  const PointCloudPtr sweep = world.cloud(robot, 4000);
  auto out = std::make_shared<PointCloud>();
  out->frame = sweep->frame;
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t k = i * sweep->size() / points;
    out->push(sweep->x[k], sweep->y[k], sweep->z[k], 0, 0, 0);
  }
  return out;
}

void sceneFrame(benchmark::State& bench) {
  testApp();
  if (!openGlAvailable()) {
    bench.SkipWithError("no OpenGL on this display");
    return;
  }
  const SampleWorld world;
  Theme theme;
  SceneState state({}, world.robot());
  const auto points = static_cast<std::size_t>(bench.range(0));
  const PointCloudPtr clouds[] = {cloudOf(world, world.status({}, 3.0), points),
                                  cloudOf(world, world.status({}, 3.1), points)};
  SceneRenderer renderer({}, RobotShape(world.robot()));
  const SceneColors colors = SceneColors::of(theme);
  OrbitCamera camera;
  double t_s = 0.0;
  std::size_t frame = 0;
  // The first frame compiles the shaders: seconds on a software renderer, once.
  for (int i = 0; i < 3; ++i) {
    state.setCloud(clouds[0]);
    benchmark::DoNotOptimize(renderer.render(state.snapshot(), camera, colors, 1000, 560));
  }
  for (auto step : bench) {
    const RobotStatus robot = world.status({}, t_s += 0.05);
    state.setStatus(robot);
    state.setCloud(clouds[frame++ % 2]);
    state.setScene(world.scene({}, robot, true));
    camera.robotAt({robot.X_map_base.x_m, robot.X_map_base.y_m, 0});
    camera.orbit(3, 0, 560);
    benchmark::DoNotOptimize(renderer.render(state.snapshot(), camera, colors, 1000, 560));
  }
  bench.counters["fps"] =
      benchmark::Counter(static_cast<double>(bench.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(sceneFrame)
    ->Arg(1000)
    ->Arg(30000)
    ->Arg(60000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->MinTime(2.0);

}  // namespace
}  // namespace kiln::gui
