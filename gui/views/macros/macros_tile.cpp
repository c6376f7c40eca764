#include "gui/views/macros/macros_tile.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QScrollArea>
#include <algorithm>
#include <utility>

#include "gui/views/teleop/dead_man.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {

constexpr int kListMin_px = 86, kNoteLines = 2;

bool sameMacros(const std::vector<MacroRow*>& rows, const std::vector<MacroInfo>& macros) {
  return std::equal(rows.begin(), rows.end(), macros.begin(), macros.end(),
                    [](const MacroRow* row, const MacroInfo& m) {
                      return row->macro().name == m.name &&
                             row->macro().duration_s == m.duration_s &&
                             row->macro().uses == m.uses &&
                             row->macro().start_condition == m.start_condition;
                    });
}

/// Those that use something up first: they are needed in a hurry, and the list shows but two
/// without scrolling.
std::vector<MacroInfo> inOrder(std::vector<MacroInfo> macros) {
  std::stable_partition(macros.begin(), macros.end(),
                        [](const MacroInfo& m) { return !m.uses.empty(); });
  return macros;
}

}  // namespace

MacrosTile::MacrosTile(const Ui& ui, HoldToRun& hold, QWidget* parent)
    : Tile(ui, tr("Macros"), parent), ui_(ui), hold_(hold), models_(hold.models()) {
  auto* content = new QWidget;
  column_ = new QVBoxLayout(content);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(6);
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
  column_->addWidget(scroll, 1);
  column_->addWidget(note_);
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

MacrosTile::~MacrosTile() {
  if (hold_.holding()) hold_.releaseAll(tr("the controls are gone"));
}

void MacrosTile::setHands(QWidget* panel) {
  delete std::exchange(hands_, panel);
  if (hands_) column_->addWidget(hands_);
}

void MacrosTile::letGo() {
  for (MacroRow* macro : rows_) {
    macro->cancel();
    macro->restart().cancel();
  }
}

void MacrosTile::rebuildRows() {
  letGo();
  for (MacroRow* row : rows_) {
    row->parentWidget()->hide();
    row->parentWidget()->deleteLater();
  }
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

void MacrosTile::refresh() {
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
  const QWidget* focus = QApplication::focusWidget();
  const bool here = focus && (focus == this || isAncestorOf(focus));
  setInfo(!hold_.lock(HoldKind::Base).isEmpty() ? QString()
          : here                                ? tr("jog keys drive")
                                                : tr("click here: jog keys drive"));
}

void MacrosTile::restyle() {
  const Palette& p = ui_.theme.colors();
  note_->setFont(ui_.theme.font(TextRole::Small));
  note_->setFixedHeight(kNoteLines * note_->fontMetrics().lineSpacing());  // what is below stays
  note_->setStyleSheet(QStringLiteral("color: %1").arg(p.dim.name()));
  refresh();
}

}  // namespace kiln::gui
