#include "gui/views/scene3d/scene_canvas.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>

#include "gui/views/scene3d/scene_labels.h"
#include "gui/views/scene3d/top_view.h"

namespace kiln::gui {

namespace {
constexpr int kClick_px = 4;       ///< a press that moves farther is a drag
constexpr double kBehind_s = 1.0;  ///< a picture under way for longer is told of
}  // namespace

SceneCanvas::SceneCanvas(const Ui& ui, const RobotShape& shape, Config config, bool open_gl,
                         QWidget* parent)
    : QWidget(parent), ui_(ui), shape_(shape), config_(config) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setFocusPolicy(Qt::ClickFocus);
  pace_.setSingleShot(true);
  pace_.setTimerType(Qt::PreciseTimer);
  connect(&pace_, &QTimer::timeout, this, &SceneCanvas::drawNow);
  connect(&ui_.theme, &Theme::changed, this, &SceneCanvas::want);
  if (open_gl) {
    render_ = std::make_unique<RenderThread>(config_.renderer, shape_);
    connect(render_.get(), &RenderThread::rendered, this, &SceneCanvas::accept);
  } else {
    camera_.setMode(OrbitCamera::Mode::Top);
  }
}

Eigen::Vector3d SceneCanvas::robot() const {
  return {snapshot_.X_map_base.x_m, snapshot_.X_map_base.y_m, 0.0};
}

void SceneCanvas::show(const SceneSnapshot& snapshot) {
  snapshot_ = snapshot;
  if (snapshot_.robot_known && !placed_) {
    placed_ = true;
    camera_.reset(robot());
  }
  if (snapshot_.robot_known) camera_.robotAt(robot());
  want();
  if (behindS() > 0.0) update();
}

double SceneCanvas::behindS() const {
  if (!under_way_ || !since_request_.isValid()) return 0.0;
  const double s = 1e-3 * static_cast<double>(since_request_.elapsed());
  return s < kBehind_s ? 0.0 : s;
}

void SceneCanvas::setCameraMode(OrbitCamera::Mode mode) {
  camera_.setMode(render_ ? mode : OrbitCamera::Mode::Top);
  camera_.robotAt(robot());
  want();
  emit cameraModeChanged();
}

void SceneCanvas::lookDownAt(const Eigen::Vector2d& p_map, double distance_m, int aside_px) {
  setCameraMode(OrbitCamera::Mode::Top);
  camera_.lookAt({p_map.x(), p_map.y(), 0.0}, distance_m);
  camera_.pan(-aside_px, 0.0, std::max(1, height()));
  want();
}

void SceneCanvas::setIntent(const SceneIntent& intent) {
  intent_ = intent;
  update();
}

void SceneCanvas::setPointing(bool pointing) {
  pointing_ = pointing;
  setCursor(pointing ? Qt::CrossCursor : Qt::ArrowCursor);
}

std::optional<Eigen::Vector2d> SceneCanvas::groundAt(const QPoint& pixel) const {
  return camera_.groundPoint({pixel.x() + 0.5, pixel.y() + 0.5}, width(), height());
}

void SceneCanvas::want() {
  wanted_ = true;
  if (under_way_ || pace_.isActive()) return;
  const auto period = static_cast<qint64>(1000.0 / config_.max_fps);
  const qint64 wait = since_request_.isValid() ? period - since_request_.elapsed() : 0;
  pace_.start(static_cast<int>(std::max<qint64>(0, wait)));
}

void SceneCanvas::drawNow() {
  if (!wanted_ || !isVisible()) return;
  wanted_ = false;
  since_request_.start();
  if (!render_) {
    update();
    return;
  }
  under_way_ = true;
  render_->request({snapshot_, camera_, SceneColors::of(ui_.theme), size() * devicePixelRatioF()});
}

void SceneCanvas::accept(const SceneFrame& frame) {
  under_way_ = false;
  frame_ = frame;
  ++pictures_;
  render_ms_ += frame.render_ms;
  frame_.image.setDevicePixelRatio(devicePixelRatioF());
  update();
  if (wanted_) want();
}

void SceneCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const SceneColors colors = SceneColors::of(ui_.theme);
  if (!render_) {
    paintTopView(painter, snapshot_, camera_, colors, shape_, size());
  } else if (frame_.image.isNull()) {
    painter.fillRect(rect(), ui_.theme.colors().scene_ground);
    painter.setPen(ui_.theme.colors().dim);
    painter.drawText(rect(), Qt::AlignCenter, tr("preparing the 3D view"));
  } else {
    painter.drawImage(rect(), frame_.image);
  }
  paintSceneOverlay(painter, snapshot_, intent_, render_ ? frame_.camera : camera_, colors, size());
  painter.setFont(ui_.theme.font(TextRole::Body));
  paintSceneLabels(painter, snapshot_, render_ ? frame_.camera : camera_, colors, size());
  if (const double behind_s = behindS(); behind_s > 0.0) {
    painter.setPen(ui_.theme.colors().caution);
    painter.drawText(rect().adjusted(8, 8, -8, -8), Qt::AlignBottom | Qt::AlignHCenter,
                     tr("the 3D view is %1 s behind").arg(behind_s, 0, 'f', 1));
  }
  emit drawn();
}

void SceneCanvas::resizeEvent(QResizeEvent*) { want(); }

void SceneCanvas::mousePressEvent(QMouseEvent* event) {
  last_mouse_ = pressed_at_ = event->pos();
  if (!pointing_ || event->button() != Qt::LeftButton) return;
  if (const auto p = groundAt(event->pos())) emit groundPressed(p->x(), p->y());
}

void SceneCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (pointing_ && (event->buttons() & Qt::LeftButton)) {
    if (const auto p = groundAt(event->pos())) emit groundDragged(p->x(), p->y());
    return;
  }
  const QPoint d = event->pos() - last_mouse_;
  last_mouse_ = event->pos();
  const OrbitCamera::Mode before = camera_.mode();
  if (event->buttons() & Qt::LeftButton)
    camera_.orbit(d.x(), d.y(), height());
  else
    camera_.pan(d.x(), d.y(), height());
  want();
  if (camera_.mode() != before) emit cameraModeChanged();  // its listeners restyle buttons: dear
}

/// A press that did not drag is a click.
void SceneCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (pointing_ || event->button() != Qt::LeftButton) return;
  if ((event->pos() - pressed_at_).manhattanLength() > kClick_px) return;
  const SceneItem* item =
      itemAt(snapshot_, render_ ? frame_.camera : camera_, size(), event->pos());
  if (item) emit itemClicked(SceneItem(*item));
}

void SceneCanvas::mouseDoubleClickEvent(QMouseEvent*) {
  if (pointing_) return;
  setCameraMode(OrbitCamera::Mode::Follow);
  camera_.reset(robot());
}

void SceneCanvas::wheelEvent(QWheelEvent* event) {
  camera_.zoom(event->angleDelta().y() / 120.0);
  want();
}

void SceneCanvas::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_F:
      return setCameraMode(OrbitCamera::Mode::Follow);
    case Qt::Key_O:
      return setCameraMode(OrbitCamera::Mode::Top);
    case Qt::Key_G:
      return setCameraMode(OrbitCamera::Mode::Free);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace kiln::gui
