#include "gui/views/scene3d/scene_tile.h"

#include <QButtonGroup>
#include <QEvent>
#include <QHBoxLayout>
#include <QStringList>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "gui/views/scene3d/layer_panel.h"
#include "gui/views/scene3d/localization_chip.h"
#include "gui/views/scene3d/pose_chip.h"
#include "gui/views/scene3d/pose_panel.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {
constexpr int kPanelOffset_px = 8;
constexpr double kSubjectDistance_m = 7.0;  // the picture is then about four metres high
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
      camera_buttons_(new QButtonGroup(this)),
      placer_(models),
      chip_(new LocalizationChip(ui, models.localization, canvas_)),
      figures_(new PoseChip(ui, models, canvas_)),
      pose_panel_(new PosePanel(ui, placer_, canvas_)) {
  setContent(canvas_, true);
  canvas_->installEventFilter(this);
  layers_->move(kPanelOffset_px, kPanelOffset_px);
  addHeaderWidget(makeCameraButtons());
  connect(layers_, &LayerPanel::toggled, this, [this](SceneLayer layer, bool visible) {
    state_.setVisible(layer, visible);
    refresh();
  });
  connect(layers_, &LayerPanel::missionToggled, this,
          [this](const std::string& layer, bool visible) {
            state_.setVisible(layer, visible);
            refresh();
          });
  connect(&models_.mission, &Model::changed, this, [this] {
    state_.setMission(models_.mission.info());
    refresh();
  });
  connect(canvas_, &SceneCanvas::cameraModeChanged, this, &SceneTile::markCameraButton);
  connect(&models_.status, &Model::changed, this, &SceneTile::takeStatus);
  connect(&models_.cloud, &Model::changed, this, [this] {
    state_.setCloud(models_.cloud.cloud());
    figures_->show(clearance_.look(state_.snapshot(), state_.geometry()));
    refresh();
  });
  connect(&models_.scene, &Model::changed, this, [this] {
    if (models_.scene.scene()) state_.setScene(*models_.scene.scene());
    refresh();
  });
  connect(&models_.localization, &Model::changed, this, [this] {
    if (models_.localization.status()) state_.setLocalization(*models_.localization.status());
    chip_->refresh();
    refresh();
  });
  connect(&models_.map, &Model::changed, this, &SceneTile::takeMap);
  connect(&models_.link, &Link::restarted, this, [this] { state_.restart(); });
  connect(canvas_, &SceneCanvas::groundPressed, &placer_, &PosePlacer::press);
  connect(canvas_, &SceneCanvas::groundDragged, &placer_, &PosePlacer::drag);
  connect(&placer_, &PosePlacer::changed, this, &SceneTile::watchPlacing);
  connect(chip_, &LocalizationChip::resized, this, &SceneTile::arrange);
  connect(&models_, &StationModels::aged, this, [this] {
    takeAges();
    chip_->refresh();
    figures_->update();
    refreshPoseButton();
    refresh();
  });
  state_.setMission(models_.mission.info());
  refresh();
}

void SceneTile::addCard(SceneCard* card) {
  cards_.push_back(card);
  connect(canvas_, &SceneCanvas::itemClicked, card, &SceneCard::open);
  QToolButton* key = addTool(*card_keys_, card->keyText());
  setTip(*key, card->keyTip());
  connect(key, &QToolButton::clicked, card, &SceneCard::toggle);
  connect(card, &QObject::destroyed, key, &QObject::deleteLater);
  connect(card, &SceneCard::resized, this, &SceneTile::arrange);
  connect(card, &SceneCard::refreshed, this, [this] {
    watchCards();
    takeIntent();
    arrange();
  });
  markCameraButton();
  arrange();
}

void SceneTile::removeCards() {
  qDeleteAll(std::exchange(cards_, {}));
  watchCards();
  takeIntent();
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

void SceneTile::takeMap() {
  state_.setMap(models_.map.layer());
  if (models_.map.trajectory()) state_.setTrajectory(*models_.map.trajectory());
  refresh();
}

void SceneTile::takeIntent() {
  SceneIntent intent;
  using Phase = PosePlacer::Phase;
  if (placer_.phase() == Phase::Placed || placer_.phase() == Phase::Sent)
    intent.robot = placer_.pose();
  for (const SceneCard* card : cards_) {
    const auto ghosts = card->isHidden() ? std::vector<SceneItem>{} : card->ghosts();
    intent.items.insert(intent.items.end(), ghosts.begin(), ghosts.end());
  }
  canvas_->setIntent(intent);
}

/// An open card is worth nothing when what it tells of is out of the picture or under the card.
void SceneTile::watchCards() {
  std::optional<Eigen::Vector2d> now;
  int card_px = 0;
  for (const SceneCard* card : cards_) {
    if (card->isHidden() || now) continue;
    now = card->subject();
    card_px = card->width();
  }
  if (now == looked_at_) return;
  if (!looked_at_) before_placing_ = canvas_->camera().mode();
  looked_at_ = now;
  if (now) {
    canvas_->lookDownAt(*now, kSubjectDistance_m, card_px / 3);
  } else {
    canvas_->setCameraMode(before_placing_);
  }
}

void SceneTile::watchPlacing() {
  const bool now = placer_.active();
  if (now && !placing_) {
    before_placing_ = canvas_->camera().mode();
    canvas_->setCameraMode(OrbitCamera::Mode::Top);
  } else if (!now && placing_) {
    canvas_->setCameraMode(before_placing_);
  }
  placing_ = now;
  canvas_->setPointing(now);
  refreshPoseButton();
  takeIntent();
  arrange();
}

void SceneTile::refreshPoseButton() {
  QString why;
  const bool may = placing_ || placer_.mayStart(&why);
  pose_button_->setEnabled(may);
  pose_button_->setChecked(placing_);
  setTip(*pose_button_,
         may ? tr("tell the robot where it stands: press on the map, drag to its heading, confirm")
             : tr("set pose: %1").arg(why));
}

void SceneTile::arrange() {
  const QSize area = canvas_->size();
  // In a low tile a card takes the whole right side, and the chip goes to the left of it.
  chip_->setWidest(0);
  bool low = false;
  int bottom = area.height() - kPanelOffset_px;
  for (SceneCard* card : cards_) {
    if (card->isHidden()) continue;
    const int beside = area.width() - card->width() - 3 * kPanelOffset_px;
    card->move(area.width() - card->width() - kPanelOffset_px,
               std::max(kPanelOffset_px, bottom - card->height()));
    bottom = card->y() - kPanelOffset_px;
    if (bottom >= chip_->height() + kPanelOffset_px) continue;
    low = true;
    chip_->setWidest(beside);
  }
  chip_->move(low ? kPanelOffset_px : area.width() - chip_->width() - kPanelOffset_px,
              kPanelOffset_px);
  figures_->setVisible(pose_panel_->isHidden());  // who places the robot does not drive it
  figures_->move(kPanelOffset_px, area.height() - figures_->height() - kPanelOffset_px);
  pose_panel_->move(std::max(kPanelOffset_px, (area.width() - pose_panel_->width()) / 2),
                    area.height() - pose_panel_->height() - kPanelOffset_px);
}

bool SceneTile::eventFilter(QObject* watched, QEvent* event) {
  if (watched == canvas_ && event->type() == QEvent::Resize) arrange();
  return Tile::eventFilter(watched, event);
}

void SceneTile::takeStatus() {
  if (const RobotStatus* status = models_.status.status()) state_.setStatus(*status);
  figures_->update();
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
  state_.setAge(SceneLayer::Planned, scene_s);
  state_.setMissionAge(scene_s);
  state_.setAge(SceneLayer::Walls, models_.scene.scene() ? 0.0 : -1.0);  // nominal: does not age
  state_.setAge(SceneLayer::Map, models_.map.layer() ? 0.0 : -1.0);
}

void SceneTile::refresh() {
  const SceneSnapshot& snapshot = state_.snapshot();
  canvas_->show(snapshot);
  layers_->show(snapshot);
  setInfo(headerText());
}

QString SceneTile::headerText() const {
  if (!state_.cloudRefusal().empty()) return QString::fromStdString(state_.cloudRefusal());
  QStringList parts;
  if (layers_->isHidden()) parts << tr("F1 layers");
  if (!canvas_->usesOpenGl()) parts << tr("top view, no OpenGL");
  const PointCloudPtr& cloud = state_.snapshot().cloud;
  parts << pointsText(cloud);
  // Last, for a narrow header leaves out the first parts.
  const RobotStatus* status = models_.status.status();
  if (!status)
    parts << tr("no data");
  else if (models_.status.ageLevel() != AgeLevel::Fresh)
    parts << tr("last heard %1 ago").arg(ageText(models_.status.ageS()));
  else if (models_.cloud.hasData() && models_.cloud.ageLevel() != AgeLevel::Fresh)
    parts << tr("cloud %1 old").arg(ageText(models_.cloud.ageS()));
  else
    parts << (status->environment == Environment::Replay ? tr("recorded") : tr("live"));
  return parts.join(QStringLiteral(" · "));
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
    setTip(*button, b.tip);
    button->setCheckable(true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    camera_buttons_->addButton(button, static_cast<int>(b.mode));
    row->addWidget(button);
  }
  row->insertSpacing(0, 6);
  card_keys_ = new QHBoxLayout;
  card_keys_->setSpacing(2);
  row->addLayout(card_keys_);
  pose_button_ = addTool(*row, tr("set pose"));
  pose_button_->setCheckable(true);
  connect(pose_button_, &QToolButton::clicked, this,
          [this] { placer_.active() ? placer_.cancel() : placer_.start(); });
  connect(camera_buttons_, &QButtonGroup::idClicked, this,
          [this](int id) { canvas_->setCameraMode(static_cast<Mode>(id)); });
  connect(&ui_.theme, &Theme::changed, this, &SceneTile::markCameraButton);
  markCameraButton();
  return bar;
}

QToolButton* SceneTile::addTool(QHBoxLayout& row, const QString& text) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  row.addWidget(button);
  return button;
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
  std::vector<QToolButton*> tools{pose_button_};
  for (int i = 0; i < card_keys_->count(); ++i)
    tools.push_back(qobject_cast<QToolButton*>(card_keys_->itemAt(i)->widget()));
  for (QToolButton* button : tools) {
    button->setFont(ui_.theme.font(TextRole::Small));
    button->setStyleSheet(
        QStringLiteral("QToolButton { border: 1px solid %3; padding: 0px 6px; border-radius: 3px;"
                       " color: %1; } QToolButton:disabled { color: %2; }"
                       " QToolButton:checked { background: %4; }")
            .arg(p.text.name(), p.faint.name(), p.border.name(), p.manual_fill.name()));
  }
}

}  // namespace kiln::gui
