#pragma once

#include <QImage>
#include <memory>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/robot_shape.h"
#include "gui/views/scene3d/scene_colors.h"
#include "gui/views/scene3d/scene_state.h"

namespace kiln::gui {

/// Draws the scene with VTK into an off-screen window and hands the picture back. Its OpenGL
/// context is its own, not Qt's: the station's other tiles stay plain raster widgets and a slow
/// frame never blocks the GUI thread. Confined to one thread, from construction to destruction.
/// Needs an X display with GLX. Cost: tests/bench/scene_bench.
class SceneRenderer {
 public:
  struct Config {
    std::size_t point_budget = 60000;  ///< LiDAR points drawn at most
    int samples = 0;                   ///< multisampling; off: expensive in software
  };
  SceneRenderer(Config config, const RobotShape& shape);
  ~SceneRenderer();
  /// @return width x height pixels; a null image if either is not positive.
  [[nodiscard]] QImage render(const SceneSnapshot& snapshot, const OrbitCamera& camera,
                              const SceneColors& colors, int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// True if this process can open an OpenGL context on its display; without it VTK would abort the
/// process, and the station draws the top view instead. Needs a QGuiApplication; call from the GUI
/// thread.
[[nodiscard]] bool openGlAvailable();

}  // namespace kiln::gui
