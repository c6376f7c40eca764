#include "gui/views/macros/macros_tile.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QToolButton>
#include <algorithm>

#include "gui/views/teleop/dead_man.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {

constexpr int kPumpWidth_px = 124, kPumpHeight_px = 120, kListMin_px = 86, kNoteLines = 2;

bool sameMacros(const std::vector<MacroRow*>& rows, const std::vector<MacroInfo>& macros) {
  return std::equal(rows.begin(), rows.end(), macros.begin(), macros.end(),
                    [](const MacroRow* row, const MacroInfo& m) {
                      return row->macro().name == m.name &&
                             row->macro().duration_s == m.duration_s &&
                             row->macro().water_l == m.water_l &&
                             row->macro().start_condition == m.start_condition;
                    });
}

/// Those that spray first: they are needed in a hurry, and the list shows but two without
/// scrolling.
std::vector<MacroInfo> inOrder(std::vector<MacroInfo> macros) {
  std::stable_partition(macros.begin(), macros.end(),
                        [](const MacroInfo& m) { return m.water_l > 0.0; });
  return macros;
}

}  // namespace

MacrosTile::MacrosTile(const Ui& ui, HoldToRun& hold, QWidget* parent)
    : Tile(ui, tr("Macros and water"), parent),
      ui_(ui),
      hold_(hold),
      models_(hold.models()),
      water_(new WaterGauge(ui)) {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  auto* macros = new QWidget;
  list_ = new QVBoxLayout(macros);
  list_->setContentsMargins(0, 0, 0, 0);
  list_->setSpacing(4);
  auto* scroll = new QScrollArea;
  scroll->setWidget(macros);
  scroll->setWidgetResizable(true);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
  scroll->setMinimumHeight(kListMin_px);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);  // one that appears moves the rows
  macros->setAutoFillBackground(false);
  scroll->viewport()->setAutoFillBackground(false);
  note_ = new Label;
  note_->setWordWrap(true);
  note_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  row->addWidget(scroll, 1);
  row->addWidget(makePump());
  column->addLayout(row, 1);
  column->addWidget(note_);
  column->addWidget(water_);
  setContent(content);
  new DeadMan(hold_, *this);
  connect(&hold_, &HoldToRun::tripped, this, [this](const QString&) {
    letGo();
    refresh();
  });
  connect(&models_.macros, &Model::changed, this, &MacrosTile::refresh);
  connect(&models_.status, &Model::changed, this, &MacrosTile::refresh);
  connect(&models_, &StationModels::aged, this, &MacrosTile::refresh);
  connect(&ui_.theme, &Theme::changed, this, &MacrosTile::restyle);
  restyle();
}

MacrosTile::~MacrosTile() { letGo(); }

void MacrosTile::letGo() {
  pump_->cancel();
  for (MacroRow* macro : rows_) {
    macro->cancel();
    macro->restart().cancel();
  }
}

QWidget* MacrosTile::makePump() {
  auto* box = new QWidget;
  box->setFixedWidth(kPumpWidth_px);
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  pump_ = new HoldButton(ui_, tr("PUMP"), 0.0);
  pump_->setFocusPolicy(
      Qt::TabFocus);  // a click leaves the keyboard with the jog keys: spray while aiming
  pump_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
  pump_->setMaximumHeight(kPumpHeight_px);
  connect(pump_, &HoldButton::engaged, this, &MacrosTile::beginPump);
  connect(pump_, &HoldButton::disengaged, this, &MacrosTile::endPump);
  sides_ = new QButtonGroup(this);
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
    if (pump_->isEngaged() && !hold_.hold(HoldKind::Pump, pumpSetpoint())) pump_->cancel();
    restyle();
  });
  column->addWidget(pump_, 1);
  column->addLayout(row);
  column->addStretch(0);
  return box;
}

HoldPump MacrosTile::pumpSetpoint() const {
  return {which_ == Pumps::Right ? 0.0 : 1.0, which_ == Pumps::Left ? 0.0 : 1.0};
}

void MacrosTile::beginPump() {
  const RobotStatus* status = models_.status.status();
  sprayed_before_l_ = status ? status->water.sprayed_l_est : 0.0;
  spray_began_ = ui_.clock.now();
  if (!hold_.hold(HoldKind::Pump, pumpSetpoint())) pump_->cancel();
  refreshPump();
}

void MacrosTile::endPump() {
  hold_.release(HoldKind::Pump);
  refreshPump();
}

void MacrosTile::rebuildRows() {
  letGo();
  for (MacroRow* row : rows_) row->parentWidget()->deleteLater();
  rows_.clear();
  while (QLayoutItem* item = list_->takeAt(0)) delete item;
  for (const MacroInfo& macro : inOrder(models_.macros.macros())) addRow(macro);
  list_->addStretch(1);
}

void MacrosTile::addRow(const MacroInfo& macro) {
  auto* line = new QWidget;
  auto* across = new QHBoxLayout(line);
  across->setContentsMargins(0, 0, 0, 0);
  across->setSpacing(3);
  auto* row = new MacroRow(ui_, macro);
  across->addWidget(row, 1);
  across->addWidget(&row->restart());
  for (HoldButton* key : {static_cast<HoldButton*>(row), &row->restart()}) {
    const bool restart = key != row;
    connect(key, &HoldButton::engaged, this, [this, key, restart, name = macro.name] {
      if (!hold_.hold(HoldKind::Macro, HoldMacro{name, restart})) key->cancel();
    });
    connect(key, &HoldButton::disengaged, this, [this] { hold_.release(HoldKind::Macro); });
  }
  list_->addWidget(line);
  rows_.push_back(row);
}

void MacrosTile::refreshMacros() {
  if (!sameMacros(rows_, inOrder(models_.macros.macros()))) rebuildRows();
  // What a silent robot was doing is not known any more.
  const bool heard = models_.status.ageLevel() != AgeLevel::Red;
  const MacroStatus running = heard ? models_.macros.running() : MacroStatus{};
  const QString why = hold_.lock(HoldKind::Macro);
  for (MacroRow* row : rows_) {
    row->setStatus(running);
    row->setEnabled(why.isEmpty());
    row->restart().setEnabled(why.isEmpty());
    row->setHint(why.isEmpty() ? tr("hold to run") : tr("locked"));
  }
  const QString last = running.running.empty() && !running.last_result.empty()
                           ? tr("last macro: %1").arg(QString::fromStdString(running.last_result))
                           : QString();
  note_->setText(rows_.empty()    ? tr("the robot offers no macros")
                 : !why.isEmpty() ? tr("macros: %1").arg(why)
                                  : last);
  setTip(*note_, note_->text());
}

void MacrosTile::refreshPump() {
  const RobotStatus* status = models_.status.status();
  const QString why = hold_.lock(HoldKind::Pump);
  pump_->setKind(pump_->isEngaged() ? ActKind::Manual : ActKind::Normal);
  pump_->setEnabled(why.isEmpty());
  setTip(*pump_,
         why.isEmpty()
             ? tr("sprays while held; the robot cuts the pumps 0.2 s after the last sign of life")
             : why);
  if (pump_->isEngaged() && status) {
    pump_->setSubtext(tr("est. %1 l · %2 s")
                          .arg(status->water.sprayed_l_est - sprayed_before_l_, 0, 'f', 2)
                          .arg(toSeconds(ui_.clock.now() - spray_began_), 0, 'f', 1));
  } else {
    pump_->setSubtext(why.isEmpty() ? tr("hold to spray") : tr("locked"));
  }
}

void MacrosTile::refresh() {
  refreshMacros();
  refreshPump();
  const RobotStatus* status = models_.status.status();
  water_->show(status ? status->water : WaterStatus{},
               status && models_.status.ageLevel() != AgeLevel::Red);
}

void MacrosTile::restyle() {
  const Palette& p = ui_.theme.colors();
  note_->setFont(ui_.theme.font(TextRole::Small));
  note_->setFixedHeight(kNoteLines * note_->fontMetrics().lineSpacing());  // what is below stays
  note_->setStyleSheet(QStringLiteral("color: %1").arg(p.dim.name()));
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
