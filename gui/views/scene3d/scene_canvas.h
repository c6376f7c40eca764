#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <memory>

#include "gui/views/scene3d/render_thread.h"
#include "gui/views/scene3d/scene_overlay.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Shows a scene snapshot: in 3D drawn by a render thread, or from above with QPainter where there
/// is no OpenGL. Draws only on new content or a moved camera, at most `max_fps` times a second, one
/// picture under way at a time. Mouse: left drag orbits, right or middle drag moves, wheel zooms,
/// double click resets. Keys: F follow, O overhead, G free.
class SceneCanvas : public QWidget {
  Q_OBJECT
 public:
  struct Config {
    SceneRenderer::Config renderer;
    double max_fps = 18.0;  ///< a little above the 15 that are wanted: timers come late
  };
  /// @param open_gl  openGlAvailable(), or false to force the top view.
  SceneCanvas(const Ui& ui, const RobotShape& shape, Config config, bool open_gl,
              QWidget* parent = nullptr);
  void show(const SceneSnapshot& snapshot);
  void setCameraMode(OrbitCamera::Mode mode);
  /// From above on a point of the ground, `aside_px` left of the middle of the picture.
  void lookDownAt(const Eigen::Vector2d& p_map, double distance_m, int aside_px);
  /// What the operator is about to do; drawn as ghosts.
  void setIntent(const SceneIntent& intent);
  /// While on, a press with the left button points at the ground instead of turning the camera.
  void setPointing(bool pointing);
  [[nodiscard]] const OrbitCamera& camera() const { return camera_; }
  /// 3D pictures shown since the start, and the mean time that one took to draw.
  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }
  [[nodiscard]] double meanRenderMs() const {
    return pictures_ > 0 ? render_ms_ / static_cast<double>(pictures_) : 0.0;
  }
  [[nodiscard]] bool usesOpenGl() const { return render_ != nullptr; }
  [[nodiscard]] double lastRenderMs() const { return frame_.render_ms; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {240, 160}; }

 signals:
  void groundPressed(double x_m, double y_m);  ///< in map; only while pointing
  void groundDragged(double x_m, double y_m);
  void itemClicked(const kiln::SceneItem& item);  ///< one with a label; not while pointing
  void cameraModeChanged();
  void drawn();  ///< a new picture is on the screen

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void want();
  /// How long the picture asked for has been under way; 0 while it is in time.
  [[nodiscard]] double behindS() const;
  void drawNow();
  void accept(const SceneFrame& frame);
  [[nodiscard]] std::optional<Eigen::Vector2d> groundAt(const QPoint& pixel) const;
  [[nodiscard]] Eigen::Vector3d robot() const;

  Ui ui_;
  RobotShape shape_;
  Config config_;
  std::unique_ptr<RenderThread> render_;  // null: top view
  SceneSnapshot snapshot_;
  SceneIntent intent_;
  bool pointing_ = false;
  OrbitCamera camera_;
  SceneFrame frame_;
  QTimer pace_;
  QElapsedTimer since_request_;
  std::uint64_t pictures_ = 0;
  double render_ms_ = 0.0;  ///< of all of them
  bool under_way_ = false, wanted_ = false, placed_ = false;
  QPoint last_mouse_, pressed_at_;
};

}  // namespace kiln::gui
