#include "gui/views/teleop/teleop_tile.h"

#include <QHBoxLayout>
#include <QSlider>
#include <QStackedWidget>
#include <cmath>

#include "gui/views/teleop/dead_man.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {
constexpr int kSpeedDelay_ms =
    250;  // one command after the slider has come to rest, not one a pixel
constexpr double kTripShown_s = 4.0;
constexpr int kSlowest_pct = 5, kDefault_pct = 35;
}  // namespace

TeleopTile::TeleopTile(const Ui& ui, HoldToRun& hold, QWidget* parent)
    : Tile(ui, tr("Take over"), parent),
      ui_(ui),
      hold_(hold),
      models_(hold.models()),
      panel_(new JogPanel(ui, hold)) {
  auto* content = new QWidget;
  auto* row = new QHBoxLayout(content);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(10);
  row->addWidget(panel_);
  row->addWidget(makeSide(), 1);
  panel_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  setContent(content);
  new DeadMan(hold_, *panel_);
  connect(enter_, &QAbstractButton::clicked, this, &TeleopTile::enterTeleop);
  connect(leave_, &HoldButton::completed, this, &TeleopTile::returnToAutonomy);
  connect(&hold_, &HoldToRun::tripped, this, [this](const QString& why) {
    trip_ = why;
    tripped_at_ = ui_.clock.now();
    refresh();
  });
  connect(&models_.status, &Model::changed, this, &TeleopTile::refresh);
  connect(&models_, &StationModels::aged, this, &TeleopTile::refresh);
  connect(&hold_, &HoldToRun::changed, this, &TeleopTile::refresh);
  connect(&ui_.theme, &Theme::changed, this, &TeleopTile::restyle);
  connect(speed_, &QSlider::valueChanged, this, [this](int percent) {
    speed_text_->setText(tr("%1 %").arg(percent));
    speed_timer_.start(kSpeedDelay_ms);
  });
  speed_timer_.setSingleShot(true);
  connect(&speed_timer_, &QTimer::timeout, this, &TeleopTile::sendSpeed);
  restyle();
  refresh();
}

TeleopTile::~TeleopTile() {
  if (hold_.holding()) hold_.releaseAll(tr("the controls are gone"));
}

QWidget* TeleopTile::makeSide() {
  auto* side = new QWidget;
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(5);
  enter_ = new ActButton(ui_, tr("To Teleop"));
  enter_->setKind(ActKind::Manual);
  enter_->setSubtext(tr("robot holds"));
  leave_ = new HoldButton(ui_, tr("To autonomy"), 1.0);
  leave_->setSubtext(tr("hold 1 s"));
  modes_ = new QStackedWidget;  // as large as either, so that a change of mode moves nothing
  modes_->addWidget(enter_);
  modes_->addWidget(leave_);
  modes_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  state_ = new FittedLabel(ui_);
  column->addWidget(modes_);
  column->addWidget(state_, 1);
  auto* row = new QHBoxLayout;
  speed_caption_ = new Label(tr("Speed"));
  speed_text_ = new Label(tr("%1 %").arg(kDefault_pct));
  row->addWidget(speed_caption_, 1);
  row->addWidget(speed_text_);
  column->addLayout(row);
  speed_ = new QSlider(Qt::Horizontal);
  speed_->setRange(kSlowest_pct, 100);
  speed_->setValue(kDefault_pct);
  speed_->setPageStep(5);
  speed_->setFocusPolicy(Qt::NoFocus);  // arrows belong to the arm
  column->addWidget(speed_);
  return side;
}

QString TeleopTile::lockReason() const { return hold_.lock(HoldKind::Base); }

void TeleopTile::enterTeleop() {
  models_.commands.send(SetMode{Mode::Teleop}, tr("enter Teleop"));
  panel_->setFocus();
}

void TeleopTile::returnToAutonomy() {
  hold_.releaseAll({});
  models_.commands.send(SetMode{Mode::Autonomous}, tr("return to autonomy"));
}

void TeleopTile::sendSpeed() {
  models_.commands.send(SetSpeedScale{speed_->value() / 100.0},
                        tr("teleop speed %1 %").arg(speed_->value()));
}

void TeleopTile::refreshMode() {
  const RobotStatus* status = models_.status.status();
  const bool teleop = status && status->mode == Mode::Teleop;
  QString why;
  const bool may = models_.mayCommand(&why);
  setTip(*enter_, may ? tr("the mission pauses, the robot holds its pose until you move it") : why);
  setTip(*leave_, may ? tr("hold for 1 s: sticks and keys are released; the mission stays paused "
                           "until you resume it")
                      : why);
  setTip(*speed_, may ? tr("share of the teleop speed at full stick; the robot applies it") : why);
  modes_->setCurrentWidget(teleop ? static_cast<QWidget*>(leave_) : enter_);
  enter_->setEnabled(may);
  leave_->setEnabled(may);
  speed_->setEnabled(may);
  if (!status || speed_->isSliderDown() || speed_timer_.isActive()) return;
  const QSignalBlocker quiet(speed_);  // what the robot confirms is shown, not sent again
  speed_->setValue(static_cast<int>(std::lround(100.0 * status->speed_scale)));
  speed_text_->setText(tr("%1 %").arg(speed_->value()));
}

void TeleopTile::refresh() {
  refreshMode();
  const QString why = lockReason();
  panel_->setLocked(!why.isEmpty());
  const Palette& p = ui_.theme.colors();
  const bool fresh_trip =
      !trip_.isEmpty() && toSeconds(ui_.clock.now() - tripped_at_) < kTripShown_s;
  const bool away = models_.status.status() && models_.status.status()->mode != Mode::Teleop;
  QString text =
      away && models_.mayCommand() ? tr("Teleop pauses the mission; the robot holds") : why;
  QColor color = p.dim;
  if (fresh_trip) {
    text = tr("let go: %1").arg(trip_);
    color = p.caution;
  } else if (why.isEmpty()) {
    const QString slow = hold_.slowdown();
    text = hold_.holding() ? tr("you drive") : tr("drag a stick, or click and use keys");
    if (!slow.isEmpty()) text = slow;
    color = !slow.isEmpty() ? p.caution : hold_.holding() ? p.manual : p.dim;
  }
  state_->set(text, color);
  setInfo(why.isEmpty() ? tr("live") : tr("locked"));
}

void TeleopTile::restyle() {
  const Palette& p = ui_.theme.colors();
  speed_text_->setFont(ui_.theme.font(TextRole::Strong));
  speed_caption_->setFont(ui_.theme.font(TextRole::Small));
  speed_caption_->setStyleSheet(QStringLiteral("color: %1").arg(p.dim.name()));
  speed_->setStyleSheet(
      QStringLiteral(
          "QSlider::groove:horizontal { height: 5px; background: %1; border-radius: 2px; }"
          "QSlider::sub-page:horizontal { background: %2; border-radius: 2px; }"
          "QSlider::handle:horizontal { background: %3; border: 1px solid %4; width: 12px; margin: "
          "-5px 0; border-radius: 6px; }")
          .arg(p.grid.name(), p.dim.name(), p.text.name(), p.border.name()));
  refresh();
}

}  // namespace kiln::gui
