#pragma once

#include <QImage>
#include <QObject>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/scene_renderer.h"

namespace kiln::gui {

/// One picture to draw.
struct SceneJob {
  SceneSnapshot snapshot;
  OrbitCamera camera;
  SceneColors colors;
  QSize pixels;
};

/// The picture, with the camera it was drawn for, so that labels land where they belong.
struct SceneFrame {
  QImage image;
  OrbitCamera camera;
  double render_ms = 0.0;
};

/// Owns the renderer on a thread of its own; a new job replaces one that waits. GUI side is the
/// owner's thread.
class RenderThread : public QObject {
  Q_OBJECT
 public:
  RenderThread(SceneRenderer::Config config, RobotShape shape, QObject* parent = nullptr);
  ~RenderThread() override;
  void request(SceneJob job);

 signals:
  /// In the owner's thread.
  void rendered(const kiln::gui::SceneFrame& frame);

 private:
  void run(const std::stop_token& stop, SceneRenderer::Config config, const RobotShape& shape);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<SceneJob> job_;
  std::jthread thread_;  // last: joined before the mailbox goes
};

}  // namespace kiln::gui
