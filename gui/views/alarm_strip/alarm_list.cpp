#include "gui/views/alarm_strip/alarm_list.h"

#include <QHBoxLayout>
#include <QPainter>
#include <QScrollArea>
#include <QScrollBar>
#include <algorithm>

#include "gui/views/alarm_strip/alarm_mark.h"
#include "gui/widgets/age_badge.h"
#include "gui/widgets/fitted_text.h"

namespace kiln::gui {

namespace {
constexpr int kMark_px = 34, kLevel_px = 96, kKey_px = 112, kKeyHeight_px = 30;
constexpr int kPad_px = 6, kHeader_px = 30;
constexpr int kMostLines = 3;
}  // namespace

AlarmRow::AlarmRow(const Ui& ui, StationModels& models, const AlarmModel::Entry& entry)
    : ui_(ui), models_(models), acknowledge_(new ActButton(ui, tr("Acknowledge"))) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, kPad_px, kPad_px, kPad_px);
  row->addStretch(1);
  row->addWidget(acknowledge_, 0, Qt::AlignVCenter);
  acknowledge_->setFixedSize(kKey_px, kKeyHeight_px);
  acknowledge_->setFocusPolicy(Qt::TabFocus);  // a click leaves the keyboard with the jog keys
  QSizePolicy kept = acknowledge_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);
  acknowledge_->setSizePolicy(kept);
  connect(acknowledge_, &QAbstractButton::clicked, this,
          [this] { models_.alarms.acknowledge(QString::fromStdString(entry_.alarm.id)); });
  show(entry);
}

bool AlarmRow::of(const AlarmModel::Entry& entry) const {
  return entry_.own == entry.own && entry_.alarm.id == entry.alarm.id;
}

void AlarmRow::show(const AlarmModel::Entry& entry) {
  entry_ = entry;
  acknowledge_->setVisible(!entry.alarm.acknowledged);
  acknowledge_->setEnabled(entry.asked == 0 && !models_.link.readOnly());
  setTip(*acknowledge_,
         models_.link.readOnly() ? tr("a recording cannot be commanded") : QString());
  updateGeometry();
  update();
}

QString AlarmRow::state() const {
  QString text;
  if (!entry_.alarm.active) {
    text = tr("over");
  } else {
    text = tr("for %1").arg(
        ageText(std::max(0.0, toSeconds(models_.robotNow() - entry_.alarm.since))));
  }
  if (entry_.asked != 0) text += tr(" · asked");
  if (entry_.alarm.acknowledged) text += tr(" · acknowledged");
  return text;
}

QStringList AlarmRow::words() const {
  return {levelWord(entry_.alarm.level), QString::fromStdString(entry_.alarm.text),
          QString::fromStdString(entry_.alarm.action), state()};
}

int AlarmRow::textRoom(int width) const {
  return width - kMark_px - kLevel_px - kKey_px - 3 * kPad_px;
}

int AlarmRow::heightForWidth(int width) const {
  const int room = textRoom(width);
  const int text =
      fitText(words()[1], {ui_.theme.font(TextRole::Strong)}, room, kMostLines).height();
  const int action =
      fitText(words()[2], {ui_.theme.font(TextRole::Small)}, room, kMostLines).height();
  return std::max(kKeyHeight_px, text + action) + 2 * kPad_px;
}

void AlarmRow::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor color = alarmColor(p, entry_.alarm);
  const bool warning = entry_.alarm.active && entry_.alarm.level == AlarmLevel::Warning;
  if (warning) painter.fillRect(rect(), p.fault_fill);
  painter.fillRect(QRect(0, height() - 1, width(), 1), p.border);
  paintAlarmMark(painter, QPointF(kMark_px / 2.0, height() / 2.0), entry_.alarm.level, color);
  const QFont strong = ui_.theme.font(TextRole::Strong), small = ui_.theme.font(TextRole::Small);
  const QStringList said = words();
  const QRectF level(kMark_px, kPad_px, kLevel_px, height() - 2 * kPad_px);
  painter.setPen(color);
  paintFitted(painter, level, Qt::AlignTop | Qt::AlignLeft,
              fitText(said[0], {strong}, kLevel_px, 1));
  painter.setPen(p.text);
  paintFitted(painter, level.adjusted(0, QFontMetrics(strong).height(), 0, 0),
              Qt::AlignTop | Qt::AlignLeft, fitText(said[3], {small}, kLevel_px - 8, 2));
  const int room = textRoom(width());
  const FittedText text = fitText(said[1], {strong}, room, kMostLines);
  const QRectF area(kMark_px + kLevel_px, kPad_px, room, height() - 2 * kPad_px);
  paintFitted(painter, area, Qt::AlignTop | Qt::AlignLeft, text);
  paintFitted(painter, area.adjusted(0, text.height(), 0, 0), Qt::AlignTop | Qt::AlignLeft,
              fitText(said[2], {small}, room, kMostLines));
}

AlarmList::AlarmList(const Ui& ui, StationModels& models, QWidget* parent)
    : QFrame(parent),
      ui_(ui),
      models_(models),
      title_(new Label(tr("Alarms"))),
      none_(new Label(tr("No alarms"))),
      scroll_(new QScrollArea) {
  setObjectName(QStringLiteral("alarms"));
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(1, 1, 1, 1);
  all->setSpacing(0);
  auto* head = new QHBoxLayout;
  head->setContentsMargins(10, 2, 4, 2);
  auto* close = new ActButton(ui_, QStringLiteral("×"));
  close->setFixedSize(kHeader_px - 4, kHeader_px - 4);
  close->setFocusPolicy(Qt::TabFocus);
  setTip(*close, tr("close (F2 or Esc)"));
  connect(close, &QAbstractButton::clicked, this, &AlarmList::toggle);
  head->addWidget(title_, 1);
  head->addWidget(close);
  all->addLayout(head);
  auto* body = new QWidget;
  column_ = new QVBoxLayout(body);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(0);
  column_->addWidget(none_);
  column_->addStretch(1);
  none_->setContentsMargins(10, 6, 6, 10);
  scroll_->setWidget(body);
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setFocusPolicy(Qt::NoFocus);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  body->setAutoFillBackground(false);
  scroll_->viewport()->setAutoFillBackground(false);
  all->addWidget(scroll_, 1);
  connect(&models_.alarms, &Model::changed, this, &AlarmList::refresh);
  connect(&models_, &StationModels::aged, this, &AlarmList::refresh);
  connect(&ui_.theme, &Theme::changed, this, &AlarmList::restyle);
  restyle();
  hide();
}

void AlarmList::toggle() {
  setVisible(isHidden());
  refresh();
  raise();
  emit resized();
}

void AlarmList::refresh() {
  if (isHidden()) return;
  const auto entries = models_.alarms.ranked();
  const std::size_t before = rows_.size();
  std::erase_if(rows_, [&](AlarmRow* row) {
    const bool gone = std::none_of(entries.begin(), entries.end(),
                                   [&](const auto* entry) { return row->of(*entry); });
    if (gone) delete row;
    return gone;
  });
  bool other = rows_.size() != before;
  for (const AlarmModel::Entry* entry : entries) {
    const auto known = std::find_if(rows_.begin(), rows_.end(),
                                    [&](const AlarmRow* row) { return row->of(*entry); });
    if (known != rows_.end()) {
      (*known)->show(*entry);
      continue;
    }
    rows_.push_back(new AlarmRow(ui_, models_, *entry));
    column_->insertWidget(column_->count() - 1, rows_.back());
    rows_.back()->setVisible(true);
    other = true;
  }
  none_->setVisible(rows_.empty());
  fitRows();
  if (!underMouse()) arrange();
  if (other) emit resized();
}

void AlarmList::arrange() {
  const auto entries = models_.alarms.ranked();
  const auto rank = [&](const AlarmRow* row) {
    return std::find_if(entries.begin(), entries.end(),
                        [&](const auto* entry) { return row->of(*entry); }) -
           entries.begin();
  };
  const auto lighter = [&](const AlarmRow* a, const AlarmRow* b) { return rank(a) < rank(b); };
  if (std::is_sorted(rows_.begin(), rows_.end(), lighter)) return;
  std::stable_sort(rows_.begin(), rows_.end(), lighter);
  int place = 1;  // behind the label that says that there are none
  for (AlarmRow* row : rows_) column_->insertWidget(place++, row);
}

void AlarmList::leaveEvent(QEvent*) { arrange(); }

void AlarmList::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  fitRows();
}

/// As high as their words need; a row has a layout of its own, which does not know them.
void AlarmList::fitRows() {
  for (AlarmRow* row : rows_)
    row->setFixedHeight(row->heightForWidth(scroll_->viewport()->width()));
}

int AlarmList::heightFor(int width, int most_px) const {
  int height = kHeader_px + 4;
  for (const AlarmRow* row : rows_) height += row->heightForWidth(width - 2);
  if (rows_.empty()) height += none_->sizeHint().height();
  return std::min(height, most_px);
}

void AlarmList::restyle() {
  const Palette& p = ui_.theme.colors();
  title_->setFont(ui_.theme.font(TextRole::Strong));
  none_->setFont(ui_.theme.font(TextRole::Body));
  setStyleSheet(
      QStringLiteral("#alarms { background: %1; border: 1px solid %2; border-radius: 4px; }")
          .arg(p.panel.name(), p.dim.name()));
}

}  // namespace kiln::gui
