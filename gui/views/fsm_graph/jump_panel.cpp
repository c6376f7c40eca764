#include "gui/views/fsm_graph/jump_panel.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>

#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kButton_px = 46, kWords_px = 62;
constexpr double kHold_s = 1.0;
}  // namespace

JumpPanel::JumpPanel(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* legend,
                     QWidget* parent)
    : QWidget(parent),
      ui_(ui),
      models_(models),
      jump_(jump),
      words_(new QStackedWidget(this)),
      rows_(new QStackedWidget(this)),
      start_(new HoldButton(ui, tr("Start mission"), kHold_s)),
      pause_(new ActButton(ui, tr("Pause"))),
      arm_(new HoldButton(ui, tr("Arm forced jump"), kHold_s)),
      card_(new Banner(ui)),
      confirm_(new HoldButton(ui, tr("Jump"), kHold_s)),
      cancel_(new ActButton(ui, tr("Cancel"))),
      message_(new Banner(ui, TextRole::Small)) {
  start_->setKind(ActKind::Primary);
  start_->setSubtext(tr("hold 1 s"));
  arm_->setKind(ActKind::Forced);
  arm_->setSubtext(tr("hold 1 s, then pick a state"));
  confirm_->setKind(ActKind::Forced);
  confirm_->setSubtext(tr("hold 1 s"));
  cancel_->setSubtext(tr("Esc"));
  for (ActButton* button : {static_cast<ActButton*>(start_), pause_, static_cast<ActButton*>(arm_),
                            static_cast<ActButton*>(confirm_), cancel_}) {
    button->setFixedHeight(kButton_px);
    // By the room alone: a longer word must not move the key beside it.
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  }
  auto* calm = new QWidget;
  auto* calm_row = new QHBoxLayout(calm);
  calm_row->setContentsMargins(0, 0, 0, 0);
  calm_row->setSpacing(8);
  calm_row->addWidget(start_, 1);
  calm_row->addWidget(pause_, 1);
  calm_row->addWidget(arm_, 1);
  auto* asking = new QWidget;
  auto* asking_row = new QHBoxLayout(asking);
  asking_row->setContentsMargins(0, 0, 0, 0);
  asking_row->setSpacing(8);
  asking_row->addWidget(confirm_, 2);  // has the state's name on it
  asking_row->addWidget(cancel_, 1);
  rows_->addWidget(calm);
  rows_->addWidget(asking);
  rows_->setFixedHeight(kButton_px);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  auto* quiet = new QWidget;
  auto* quiet_column = new QVBoxLayout(quiet);
  quiet_column->setContentsMargins(0, 0, 0, 0);
  quiet_column->setSpacing(2);
  quiet_column->addWidget(legend);
  quiet_column->addWidget(message_, 1);
  quiet_column->addStretch(0);
  auto* question = new QWidget;
  auto* question_column = new QVBoxLayout(question);
  question_column->setContentsMargins(0, 0, 0, 0);
  question_column->addWidget(card_);
  words_->addWidget(quiet);
  words_->addWidget(question);
  words_->setFixedHeight(kWords_px);  // the graph above stands still
  column->addWidget(words_);
  column->addWidget(rows_);

  connect(start_, &HoldButton::completed, this,
          [this] { models_.commands.send(StartMission{}, tr("start the mission")); });
  connect(pause_, &QAbstractButton::clicked, this, &JumpPanel::pauseOrResume);
  connect(arm_, &HoldButton::completed, &jump_, &ForcedJump::arm);
  connect(confirm_, &HoldButton::completed, &jump_, &ForcedJump::confirm);
  connect(cancel_, &QAbstractButton::clicked, this, [this] { jump_.cancel(); });
  connect(&jump_, &ForcedJump::changed, this, &JumpPanel::refresh);
  for (const Model* model :
       {static_cast<const Model*>(&models_.status), static_cast<const Model*>(&models_.lease),
        static_cast<const Model*>(&models_.fsm), static_cast<const Model*>(&models_.stop)}) {
    connect(model, &Model::changed, this, &JumpPanel::refreshMission);
  }
  connect(&models_, &StationModels::aged, this, &JumpPanel::refreshMission);
  connect(&ui_.theme, &Theme::changed, this, &JumpPanel::refresh);
  refresh();
  refreshMission();
}

/// Why a mission cannot be started; empty: it can.
QString JumpPanel::startLock() const {
  QString why;
  if (!models_.mayCommand(&why)) return why;
  const RobotStatus& status = *models_.status.status();
  if (status.mode == Mode::Teleop)
    return tr("a mission does not start in Teleop: hold \"To autonomy\" first");
  if (status.word == StatusWord::Ready) return {};
  return status.reason.empty() ? tr("the robot is not ready")
                               : tr("not ready: %1").arg(QString::fromStdString(status.reason));
}

/// Why a held mission cannot go on; empty: it can.
QString JumpPanel::resumeLock() const {
  QString why;
  if (!models_.mayCommand(&why)) return why;
  if (models_.status.status()->mode == Mode::Teleop)
    return tr("the mission rests in Teleop: go back to autonomy, then resume it");
  const LocalizationStatus* where = models_.localization.status();
  if (where && where->health == LocalizationHealth::Lost)
    return tr("position lost: set the pose on the map, drive by hand or call a reset");
  return {};
}

void JumpPanel::refreshMission() {
  QString why;
  const bool may = models_.mayCommand(&why);
  const FsmStatus* fsm = models_.fsm.status();
  const bool running = fsm && fsm->running;
  const bool paused = fsm && fsm->paused;
  start_->setVisible(!running);
  pause_->setVisible(running);
  const QString start_lock = startLock(), pause_lock = paused ? resumeLock() : why;
  start_->setEnabled(start_lock.isEmpty());
  pause_->setEnabled(pause_lock.isEmpty());
  arm_->setEnabled(may);
  pause_->setText(paused ? tr("Resume mission") : tr("Pause"));
  pause_->setSubtext(paused ? tr("goes on from here") : tr("rests where it stands"));
  pause_->setKind(paused ? ActKind::Primary : ActKind::Normal);
  setTip(*start_, start_lock.isEmpty() ? tr("The robot begins to drive.") : start_lock);
  setTip(*pause_, pause_lock);
  setTip(*arm_, may ? tr("Choose the next state yourself.") : why);
}

void JumpPanel::refresh() {
  const ForcedJump::Phase phase = jump_.phase();
  const bool picked = phase == ForcedJump::Phase::Picked;
  const bool asking = picked || phase == ForcedJump::Phase::Armed;
  if (asking != (rows_->currentIndex() == 1)) rows_->setCurrentIndex(asking ? 1 : 0);
  confirm_->setEnabled(picked);
  confirm_->setText(picked ? tr("Jump to %1").arg(models_.fsm.label(jump_.target()))
                           : tr("pick a state above"));
  cancel_->setSubtext(asking ? tr("Esc · %1 s").arg(std::ceil(jump_.leftS()), 0, 'f', 0)
                             : tr("Esc"));
  card_->set(
      picked ? markup(tr("Leave <b>%1</b>, enter <b>%2</b><br>%3"), models_.fsm.label(jump_.from()),
                      models_.fsm.label(jump_.target()), jump_.consequence())
             : Markup(),
      BannerKind::Forced);
  words_->setCurrentIndex(picked ? 1 : 0);
  const QString text =
      phase == ForcedJump::Phase::Sent ? tr("sent, waiting for the robot …") : jump_.message();
  message_->set(jump_.failed() && !text.isEmpty() ? QStringLiteral("✕ ") + text : text,
                jump_.failed() ? BannerKind::Caution : BannerKind::Plain);
}

void JumpPanel::pauseOrResume() {
  const FsmStatus* fsm = models_.fsm.status();
  if (fsm && fsm->paused)
    models_.commands.send(Resume{}, tr("resume"));
  else
    models_.commands.send(Pause{}, tr("pause"));
}

}  // namespace kiln::gui
