#include "gui/views/scene3d/scene_tile.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QToolButton>

#include "gui/views/scene3d/layer_panel.h"

namespace kiln::gui {
namespace {
constexpr int kPanelOffset_px = 8;
constexpr int kRoomForPanel_px = 640;  // in a smaller tile the list of layers would hide the robot

QString pointsText(const PointCloudPtr& cloud) {
  if (!cloud) return SceneTile::tr("no cloud");
  if (cloud->size() < 1000) return SceneTile::tr("%1 points").arg(cloud->size());
  return SceneTile::tr("%1 k points").arg(static_cast<double>(cloud->size()) / 1000.0, 0, 'f', 0);
}
}  // namespace

SceneTile::SceneTile(const Ui& ui, StationModels& models, RobotGeometry geometry, bool open_gl,
                     QWidget* parent)
    : Tile(ui, tr("Scene"), parent),
      ui_(ui),
      models_(models),
      state_({}, std::move(geometry)),
      canvas_(new SceneCanvas(ui, RobotShape(state_.geometry()), {}, open_gl)),
      layers_(new LayerPanel(ui, canvas_)),
      camera_buttons_(new QButtonGroup(this)) {
  setContent(canvas_, true);
  layers_->move(kPanelOffset_px, kPanelOffset_px);
  addHeaderWidget(makeCameraButtons());
  connect(layers_, &LayerPanel::toggled, this, [this](SceneLayer layer, bool visible) {
    state_.setVisible(layer, visible);
    refresh();
  });
  connect(canvas_, &SceneCanvas::cameraModeChanged, this, &SceneTile::markCameraButton);
  connect(&models_.status, &Model::changed, this, &SceneTile::takeStatus);
  connect(&models_.cloud, &Model::changed, this, [this] {
    state_.setCloud(models_.cloud.cloud());
    refresh();
  });
  connect(&models_.scene, &Model::changed, this, [this] {
    if (models_.scene.scene()) state_.setScene(*models_.scene.scene());
    refresh();
  });
  connect(&models_, &StationModels::aged, this, [this] {
    takeAges();
    refresh();
  });
  refresh();
}

void SceneTile::toggleLayerPanel() {
  panel_chosen_ = true;
  layers_->setVisible(layers_->isHidden());
  refresh();
}

void SceneTile::resizeEvent(QResizeEvent* event) {
  Tile::resizeEvent(event);
  if (!panel_chosen_) layers_->setVisible(width() >= kRoomForPanel_px);
  refresh();
}

void SceneTile::takeStatus() {
  if (const RobotStatus* status = models_.status.status()) state_.setStatus(*status);
  refresh();
}

void SceneTile::takeAges() {
  const double status_s = models_.status.ageS();
  state_.setAge(SceneLayer::Robot, status_s);
  state_.setAge(SceneLayer::Driven, status_s);
  state_.setAge(SceneLayer::Lidar, models_.cloud.ageS());
  // The overlay is repeated every 2 s only: as long as the robot speaks it is what the robot
  // believes.
  const double scene_s =
      models_.scene.scene()
          ? (models_.scene.ageLevel() == AgeLevel::Red ? models_.scene.ageS() : status_s)
          : -1.0;
  for (const SceneLayer l :
       {SceneLayer::Planned, SceneLayer::Places, SceneLayer::Fire, SceneLayer::Jet})
    state_.setAge(l, scene_s);
  state_.setAge(SceneLayer::Map, models_.scene.scene() ? 0.0 : -1.0);  // nominal: does not age
}

void SceneTile::refresh() {
  const SceneSnapshot& snapshot = state_.snapshot();
  canvas_->show(snapshot);
  layers_->show(snapshot);
  const QString refusal = QString::fromStdString(state_.cloudRefusal());
  QString info = canvas_->usesOpenGl()
                     ? tr("map · %1").arg(pointsText(snapshot.cloud))
                     : tr("top view, no OpenGL · %1").arg(pointsText(snapshot.cloud));
  if (layers_->isHidden()) info = tr("F1 layers · ") + info;
  setInfo(refusal.isEmpty() ? info : refusal);
}

QWidget* SceneTile::makeCameraButtons() {
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2);
  using Mode = OrbitCamera::Mode;
  const struct {
    QString text, tip;
    Mode mode;
  } kButtons[] = {
      {tr("follow"), tr("camera keeps the robot in the middle (F); drag to look from another side"),
       Mode::Follow},
      {tr("top"), tr("straight down, X up (O)"), Mode::Top},
      {tr("free"), tr("camera stays where it is (G)"), Mode::Free}};
  for (const auto& b : kButtons) {
    if (!canvas_->usesOpenGl() && b.mode != Mode::Top) continue;
    auto* button = new QToolButton;
    button->setText(b.text);
    button->setToolTip(b.tip);
    button->setCheckable(true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    camera_buttons_->addButton(button, static_cast<int>(b.mode));
    row->addWidget(button);
  }
  connect(camera_buttons_, &QButtonGroup::idClicked, this,
          [this](int id) { canvas_->setCameraMode(static_cast<Mode>(id)); });
  connect(&ui_.theme, &Theme::changed, this, &SceneTile::markCameraButton);
  markCameraButton();
  return bar;
}

void SceneTile::markCameraButton() {
  const Palette& p = ui_.theme.colors();
  for (QAbstractButton* button : camera_buttons_->buttons()) {
    const bool on = camera_buttons_->id(button) == static_cast<int>(canvas_->camera().mode());
    button->setChecked(on);
    button->setFont(ui_.theme.font(TextRole::Small));
    button->setStyleSheet(
        QStringLiteral("QToolButton { border: none; padding: 1px 6px; border-radius: 3px;"
                       " color: %1; background: %2; }")
            .arg(on ? p.text.name() : p.dim.name(),
                 on ? p.raised.name() : QStringLiteral("transparent")));
  }
}

}  // namespace kiln::gui
