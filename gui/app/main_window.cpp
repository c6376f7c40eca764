#include "gui/app/main_window.h"

#include <QApplication>
#include <QBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPainter>

#include "gui/app/mission_panels.h"
#include "gui/app/tile_layout.h"
#include "gui/link/replay_link.h"
#include "gui/views/alarm_strip/alarm_list.h"
#include "gui/views/alarm_strip/alarm_strip.h"
#include "gui/views/camera/camera_tile.h"
#include "gui/views/fsm_graph/fsm_tile.h"
#include "gui/views/log/log_view.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/record/record_chip.h"
#include "gui/views/replay/replay_bar.h"
#include "gui/views/scene3d/scene_tile.h"
#include "gui/views/state_card/state_card.h"
#include "gui/views/teleop/teleop_tile.h"
#include "gui/views/timeline/timeline_view.h"
#include "gui/views/top_bar/top_bar.h"

namespace kiln::gui {

namespace {
constexpr int kFrame_px = 4;
constexpr int kGap_px = 6;
}  // namespace

MainWindow::MainWindow(const Ui& ui, StationModels& models, const Options& options)
    : ui_(ui),
      models_(models),
      jump_(models),
      hold_(models),
      top_bar_(new TopBar(ui, models)),
      fsm_(new FsmTile(ui, models, jump_)),
      state_(new StateCard(ui, models, jump_)),
      alarms_(new AlarmStrip(ui, models)),
      alarm_list_(new AlarmList(ui, models, this)) {
  setWindowTitle(QStringLiteral("Kiln station"));
  setMinimumSize(TileLayout::kLeast);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kFrame_px, kFrame_px, kFrame_px, kFrame_px);
  column->setSpacing(kGap_px);
  column->addWidget(top_bar_);
  makeTiles(options);
  column->addLayout(layout_->middle(), 1);
  if (options.replay) {
    replay_bar_ = new ReplayBar(ui_, *options.replay);
    column->addWidget(replay_bar_);
  }
  column->addLayout(layout_->bottom());
  column->addWidget(alarms_);
  new MissionPanels({ui_, models_, hold_, options.geometry}, {image_row_, scene_, macros_, camera_},
                    *options.panels, this);
  connect(alarms_, &AlarmStrip::listRequested, alarm_list_, &AlarmList::toggle);
  connect(alarm_list_, &AlarmList::resized, this, &MainWindow::placeAlarmList);
  connect(alarms_, &AlarmStrip::logRequested, this, [this] { showLog(!layout_->logShown()); });
  connect(&jump_, &ForcedJump::changed, this, [this] {
    if (jump_.phase() != ForcedJump::Phase::Idle) layout_->bringToFront(*fsm_);
  });
  connect(&models_, &StationModels::aged, this, &MainWindow::refreshFrame);
  connect(&models_.status, &Model::changed, this, &MainWindow::refreshFrame);
  connect(&models_.lease, &Model::changed, this, &MainWindow::refreshFrame);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  qApp->installEventFilter(this);
}

MainWindow::~MainWindow() {
  if (qApp) qApp->removeEventFilter(this);
  // The views refer to what this window owns.
  qDeleteAll(findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly));
}

void MainWindow::makeTiles(const Options& options) {
  scene_ = new SceneTile(ui_, models_, options.geometry, options.open_gl);
  auto* images = new QWidget;
  image_row_ = new QHBoxLayout(images);
  image_row_->setContentsMargins(0, 0, 0, 0);
  image_row_->setSpacing(kGap_px);
  camera_ = new CameraTile(ui_, models_);
  image_row_->addWidget(camera_, 5);
  auto* teleop = new TeleopTile(ui_, hold_);
  macros_ = new MacrosTile(ui_, hold_);
  teleop->panel().listenIn(*macros_);
  timeline_ = new TimelineView(ui_, models_);
  timeline_tile_ = new Tile(ui_, tr("Timeline"));
  timeline_tile_->setContent(timeline_);
  timeline_tile_->addHeaderWidget(new RecordChip(ui_, models_));
  auto* log = new Tile(ui_, tr("Event log"));
  log->setContent(new LogView(ui_, models_));
  connect(timeline_, &TimelineView::viewChanged, this, &MainWindow::refreshTimelineTile);
  if (ReplayLink* replay = options.replay)
    connect(timeline_, &TimelineView::seekWanted, replay, &ReplayLink::seek);
  refreshTimelineTile();
  layout_ = new TileLayout(
      ui_, {fsm_, scene_, images, timeline_tile_, log, state_, teleop, macros_}, *this);
}

void MainWindow::showLog(bool shown) { layout_->showLog(shown); }

void MainWindow::refreshTimelineTile() {
  const QString span = tr("%1 s").arg(timeline_->spanS(), 0, 'f', 0);
  if (models_.link.readOnly())
    timeline_tile_->setInfo(tr("click: go there · double-click: all · %1 shown").arg(span));
  else
    timeline_tile_->setInfo(tr("%1 · last %2")
                                .arg(timeline_->following()
                                         ? tr("follows now")
                                         : tr("looking back, double-click to follow"),
                                     span));
}

MainWindow::Frame MainWindow::frame() const {
  if (models_.link.readOnly()) return Frame::Replay;
  if (!models_.status.hasData()) return Frame::None;
  const LinkState link = models_.link_state.health().state;
  if (models_.status.ageLevel() != AgeLevel::Fresh || link == LinkState::Degraded ||
      link == LinkState::Lost) {
    return Frame::Degraded;
  }
  return models_.lease.mine() && models_.status.word() == StatusWord::Teleop ? Frame::Driving
                                                                             : Frame::None;
}

void MainWindow::refreshFrame() {
  if (frame() == shown_frame_) return;
  shown_frame_ = frame();
  update();
}

void MainWindow::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.fillRect(rect(), p.ground);
  if (shown_frame_ == Frame::None) return;
  painter.setPen(QPen(shown_frame_ == Frame::Driving  ? p.manual
                      : shown_frame_ == Frame::Replay ? p.replay
                                                      : p.caution,
                      kFrame_px));
  painter.drawRect(QRectF(rect()).adjusted(kFrame_px / 2.0, kFrame_px / 2.0, -kFrame_px / 2.0,
                                           -kFrame_px / 2.0));
}

void MainWindow::resizeEvent(QResizeEvent*) {
  layout_->arrange(size());
  placeAlarmList();
}

/// Over the strip, and never over what is held: the right column stays free.
void MainWindow::placeAlarmList() {
  layout()->activate();
  const int left = alarms_->x(), bottom = alarms_->y() - kGap_px;
  const int width = state_->mapTo(this, QPoint()).x() - kGap_px - left;
  const int height =
      alarm_list_->heightFor(width, bottom - top_bar_->geometry().bottom() - kGap_px);
  alarm_list_->setGeometry(left, bottom - height, width, height);
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  // Keys are taken before any widget sees them: STOP must not depend on where the focus is.
  if (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) {
    auto* widget = qobject_cast<QWidget*>(watched);
    if (!widget || widget->window() != this) return QWidget::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool stop = key->key() == Qt::Key_Space || key->key() == Qt::Key_Pause;
    if (stop) {
      if (event->type() == QEvent::KeyPress && !key->isAutoRepeat()) models_.stop.press();
      event->accept();
      return true;
    }
    const bool typing = qobject_cast<QLineEdit*>(QApplication::focusWidget()) != nullptr;
    if (event->type() == QEvent::KeyPress && !typing && handleReplayKey(*key)) return true;
    const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    if (event->type() == QEvent::KeyPress && plain && !key->isAutoRepeat() &&
        handleKey(key->key(), typing))
      return true;
  }
  return QWidget::eventFilter(watched, event);
}

bool MainWindow::handleReplayKey(const QKeyEvent& key) {
  if (!replay_bar_) return false;
  const bool shift = key.modifiers() & Qt::ShiftModifier;
  switch (key.key()) {
    case Qt::Key_P:
      if (!key.isAutoRepeat()) replay_bar_->togglePlaying();
      return true;
    case Qt::Key_Comma:
    case Qt::Key_Less:
      replay_bar_->step(shift ? -ReplayBar::kJump_s : -ReplayBar::kStep_s);
      return true;
    case Qt::Key_Period:
    case Qt::Key_Greater:
      replay_bar_->step(shift ? ReplayBar::kJump_s : ReplayBar::kStep_s);
      return true;
    case Qt::Key_BracketLeft:
      replay_bar_->changeSpeed(-1);
      return true;
    case Qt::Key_BracketRight:
      replay_bar_->changeSpeed(+1);
      return true;
    default:
      return false;
  }
}

bool MainWindow::handleKey(int key, bool typing) {
  if (key == Qt::Key_Escape) {
    jump_.cancel();
    scene_->posePlacer().cancel();
    for (SceneCard* card : scene_->cards()) card->cancel();
    if (alarm_list_->isVisible()) alarm_list_->toggle();
    fsm_->endSearch();
    return true;
  }
  if (key == Qt::Key_F11) {
    setWindowState(windowState() ^ Qt::WindowFullScreen);
    return true;
  }
  if (key == Qt::Key_F2) {
    alarm_list_->toggle();
    return true;
  }
  if (key == Qt::Key_F1) {
    scene_->toggleLayerPanel();
    return true;
  }
  if (typing) return false;
  if (key == Qt::Key_Slash) {
    layout_->bringToFront(*fsm_);
    fsm_->beginSearch();
    return true;
  }
  if (key == Qt::Key_T) {
    ui_.theme.toggle();
    return true;
  }
  if (key == Qt::Key_L) {
    showLog(!layout_->logShown());
    return true;
  }
  return false;
}

}  // namespace kiln::gui
