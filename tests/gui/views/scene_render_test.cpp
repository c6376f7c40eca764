#include <QEventLoop>
#include <QTimer>

#include "gui/views/scene3d/scene_canvas.h"
#include "tests/gui/views/sample_world.h"
#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

int differing(const QImage& a, const QImage& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) count += a.pixel(x, y) != b.pixel(x, y);
  return count;
}

TEST_F(StationTest, RendererShowsAndHidesLayers) {
  if (!openGlAvailable())
    GTEST_SKIP() << "no OpenGL on this display: install libgl1-mesa-dri (software rendering), or "
                    "start the tests on an X display with GLX";
  const SampleWorld world;
  SceneState state({}, world.robot());
  const RobotStatus robot = world.status({}, 5.0);
  state.setStatus(robot);
  state.setCloud(world.cloud(robot, 300));
  state.setScene(world.scene({}, robot, false));
  OrbitCamera camera;
  camera.reset({robot.X_map_base.x_m, robot.X_map_base.y_m, 0});
  SceneRenderer renderer({}, RobotShape(world.robot()));
  const auto draw = [&] {
    return renderer.render(state.snapshot(), camera, SceneColors::of(theme), 320, 240);
  };
  const QImage all = draw();
  ASSERT_EQ(all.size(), QSize(320, 240));
  for (const SceneLayer layer : {SceneLayer::Robot, SceneLayer::Lidar, SceneLayer::Walls}) {
    state.setVisible(layer, false);
    EXPECT_GT(differing(all, draw()), 200) << toString(layer);
    state.setVisible(layer, true);
  }
  EXPECT_EQ(differing(all, draw()), 0);  // and back again
  EXPECT_TRUE(renderer.render(state.snapshot(), camera, SceneColors::of(theme), 0, 240).isNull());
}

TEST_F(StationTest, CanvasDrawsOnceForOneChangeAndThenRests) {
  const SampleWorld world;
  SceneCanvas canvas(ui, RobotShape(world.robot()), {}, openGlAvailable());
  canvas.resize(320, 240);
  canvas.QWidget::show();
  int drawn = 0;
  QEventLoop loop;
  QObject::connect(&canvas, &SceneCanvas::drawn, [&] {
    ++drawn;
    if (canvas.lastRenderMs() > 0.0 || !canvas.usesOpenGl()) loop.quit();
  });
  SceneState state({}, world.robot());
  state.setStatus(world.status({}, 5.0));
  canvas.show(state.snapshot());
  QTimer::singleShot(20000, &loop, &QEventLoop::quit);
  loop.exec();
  ASSERT_GT(drawn, 0);
  for (int i = 0; i < 50; ++i) QCoreApplication::processEvents();
  const int settled = drawn;
  for (int i = 0; i < 50; ++i) QCoreApplication::processEvents();
  EXPECT_EQ(drawn, settled);
}

}  // namespace
}  // namespace kiln::gui
