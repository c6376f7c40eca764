#include "gui/panels/fire/pump_panel.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QToolButton>

#include "common/wire/fire/fire_view.h"
#include "gui/panels/fire/work_pose.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {
constexpr int kPumpWidth_px = 124, kPumpHeight_px = 56;
}  // namespace

PumpPanel::PumpPanel(const Ui& ui, HoldToRun& hold, QWidget* parent)
    : QWidget(parent),
      ui_(ui),
      hold_(hold),
      models_(hold.models()),
      sides_(new QButtonGroup(this)),
      water_(new WaterGauge(ui)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  row->addWidget(makeKeys());
  auto* column = new QVBoxLayout;
  column->setSpacing(0);
  column->addWidget(new WorkPoseLine(ui, models_));
  column->addWidget(water_);
  row->addLayout(column, 1);
  connect(&hold_, &HoldToRun::tripped, this, [this](const QString&) {
    pump_->cancel();
    refresh();
  });
  connect(&models_.status, &Model::changed, this, &PumpPanel::refresh);
  connect(&models_, &StationModels::aged, this, &PumpPanel::refresh);
  connect(&ui_.theme, &Theme::changed, this, &PumpPanel::restyle);
  restyle();
}

PumpPanel::~PumpPanel() { pump_->cancel(); }

QWidget* PumpPanel::makeKeys() {
  auto* box = new QWidget;
  box->setFixedWidth(kPumpWidth_px);
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  pump_ = new HoldButton(ui_, tr("PUMP"), 0.0);
  pump_->setFocusPolicy(
      Qt::TabFocus);  // a click leaves the keyboard with the jog keys: spray while aiming
  pump_->setFixedHeight(kPumpHeight_px);
  connect(pump_, &HoldButton::engaged, this, &PumpPanel::begin);
  connect(pump_, &HoldButton::disengaged, this, &PumpPanel::end);
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  const QString names[] = {tr("both"), tr("left"), tr("right")};
  for (int i = 0; i < 3; ++i) {
    auto* button = new QToolButton;
    button->setText(names[i]);
    button->setCheckable(true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    sides_->addButton(button, i);
    row->addWidget(button, 1);
  }
  connect(sides_, &QButtonGroup::idClicked, this, [this](int id) {
    which_ = static_cast<Pumps>(id);
    if (pump_->isEngaged() && !hold_.hold(HoldKind::Actuator, setpoint())) pump_->cancel();
    restyle();
  });
  column->addWidget(pump_);
  column->addLayout(row);
  return box;
}

HoldActuator PumpPanel::setpoint() const {
  return {which_ == Pumps::Both ? kPumps : which_ == Pumps::Left ? kPumpLeft : kPumpRight, 1.0};
}

WaterLevels PumpPanel::water() const {
  const RobotStatus* status = models_.status.status();
  return status ? fire::waterLevels(status->figures) : WaterLevels{};
}

void PumpPanel::begin() {
  sprayed_before_l_ = water().sprayed_l_est;
  spray_began_ = ui_.clock.now();
  if (!hold_.hold(HoldKind::Actuator, setpoint())) pump_->cancel();
  refresh();
}

void PumpPanel::end() {
  hold_.release(HoldKind::Actuator);
  refresh();
}

void PumpPanel::refresh() {
  const bool known = models_.status.hasData();
  const QString why = hold_.lock(HoldKind::Actuator);
  pump_->setKind(pump_->isEngaged() ? ActKind::Manual : ActKind::Normal);
  pump_->setEnabled(why.isEmpty());
  setTip(*pump_,
         why.isEmpty()
             ? tr("sprays while held; the robot cuts the pumps 0.2 s after the last sign of life")
             : why);
  if (pump_->isEngaged() && known) {
    pump_->setSubtext(tr("est. %1 l · %2 s")
                          .arg(water().sprayed_l_est - sprayed_before_l_, 0, 'f', 2)
                          .arg(toSeconds(ui_.clock.now() - spray_began_), 0, 'f', 1));
  } else {
    pump_->setSubtext(why.isEmpty() ? tr("hold to spray") : tr("locked"));
  }
  water_->show(water(), known && models_.status.ageLevel() != AgeLevel::Red);
}

void PumpPanel::restyle() {
  const Palette& p = ui_.theme.colors();
  for (QAbstractButton* button : sides_->buttons()) {
    const bool on = sides_->id(button) == static_cast<int>(which_);
    button->setChecked(on);
    button->setFont(ui_.theme.font(TextRole::Small));
    button->setStyleSheet(QStringLiteral("QToolButton { border: none; border-radius: 3px; padding: "
                                         "2px 4px; color: %1; background: %2; }")
                              .arg(on ? p.text.name() : p.dim.name(),
                                   on ? p.raised.name() : QStringLiteral("transparent")));
  }
  refresh();
}

}  // namespace kiln::gui
