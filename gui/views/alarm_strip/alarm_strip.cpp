#include "gui/views/alarm_strip/alarm_strip.h"

#include <QFontMetrics>
#include <QHBoxLayout>
#include <QMouseEvent>
#include <QPainter>

#include "gui/views/alarm_strip/alarm_mark.h"
#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kHeight_px = 36;
constexpr int kText_px = 34;
}  // namespace

AlarmStrip::AlarmStrip(const Ui& ui, StationModels& models, QWidget* parent)
    : QWidget(parent),
      ui_(ui),
      models_(models),
      acknowledge_(new ActButton(ui, tr("Acknowledge"), this)),
      log_(new ActButton(ui, tr("Event log"), this)) {
  setFixedHeight(kHeight_px);
  setCursor(Qt::PointingHandCursor);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 3, 4, 3);
  row->setSpacing(6);
  row->addStretch(1);
  for (ActButton* button : {acknowledge_, log_}) {
    button->setFixedSize(112, kHeight_px - 6);
    row->addWidget(button);
  }
  QSizePolicy kept = acknowledge_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);
  acknowledge_->setSizePolicy(kept);
  setTip(*log_, tr("Show or hide the event log (L)"));
  connect(acknowledge_, &QAbstractButton::clicked, this, [this] {
    if (const auto* next = models_.alarms.next())
      models_.alarms.acknowledge(QString::fromStdString(next->alarm.id));
  });
  connect(log_, &QAbstractButton::clicked, this, &AlarmStrip::logRequested);
  connect(&models_.alarms, &Model::changed, this, &AlarmStrip::refresh);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  refresh();
}

QString AlarmStrip::text() const {
  const auto* top = models_.alarms.top();
  if (!top) return {};
  QString text = QString::fromStdString(top->alarm.text);
  if (!top->alarm.action.empty())
    text += QStringLiteral(": ") + QString::fromStdString(top->alarm.action);
  if (!top->alarm.active) text += tr(" (over)");
  if (top->asked != 0) text += tr(" (acknowledging …)");
  if (top->alarm.active && top->alarm.acknowledged) text += tr(" (acknowledged)");
  return text;
}

QString AlarmStrip::summary() const {
  const int active = models_.alarms.activeCount();
  const int open = models_.alarms.unacknowledgedCount();
  if (active == 0 && open == 0) return {};
  QString text = tr("%1 active").arg(active);
  if (open > 0) text += tr(" · %1 to acknowledge").arg(open);
  const auto* first = models_.alarms.firstOut();
  if (first && first != models_.alarms.top())
    text += tr(" · first: %1").arg(QString::fromStdString(first->alarm.text));
  return text;
}

void AlarmStrip::refresh() {
  const auto* next = models_.alarms.next();
  const bool other = next && next != models_.alarms.top();
  acknowledge_->setVisible(next != nullptr);
  acknowledge_->setText(other ? tr("Ack. one over") : tr("Acknowledge"));
  acknowledge_->setEnabled(!models_.link.readOnly());
  setTip(*acknowledge_,
         models_.link.readOnly() ? tr("a recording cannot be commanded") : QString());
  setTip(*this, text().isEmpty() ? tr("Show all alarms (F2)")
                                 : tr("%1\nClick: all alarms (F2)").arg(text()));
  update();
}

void AlarmStrip::mousePressEvent(QMouseEvent* event) {
  event->accept();
  emit listRequested();
}

void AlarmStrip::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto* top = models_.alarms.top();
  const AlarmLevel level = top ? top->alarm.level : AlarmLevel::Advisory;
  const bool loud = top && top->alarm.active;
  const bool warning = loud && level == AlarmLevel::Warning;
  const bool caution = loud && level == AlarmLevel::Caution;
  painter.setPen(QPen(warning ? p.fault : caution ? p.caution : p.border, 1));
  painter.setBrush(warning ? p.fault_fill : p.panel);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
  const int right = acknowledge_->x() - 10;
  const QFont small = ui_.theme.font(TextRole::Small);
  const QString note = summary();
  const int note_width = std::min(QFontMetrics(small).horizontalAdvance(note) + 4, width() / 3);
  painter.setFont(small);
  painter.setPen(top ? p.text : p.dim);
  painter.drawText(QRect(right - note_width, 0, note_width, height()),
                   Qt::AlignVCenter | Qt::AlignRight,
                   QFontMetrics(small).elidedText(note, Qt::ElideRight, note_width));
  if (!top) {
    painter.drawText(QRect(12, 0, right, height()), Qt::AlignVCenter | Qt::AlignLeft,
                     tr("No alarms"));
    return;
  }
  const QColor color = warning ? p.fault : caution ? p.caution : p.text;
  painter.fillRect(QRectF(1, 1, 5, height() - 2), color);
  paintAlarmMark(painter, QPointF(20, height() / 2.0), level, color);
  const QFont strong = ui_.theme.font(TextRole::Strong);
  const QFont body = ui_.theme.font(TextRole::Body);
  painter.setFont(strong);
  painter.setPen(color);
  const QString word = levelWord(level);
  painter.drawText(QRect(kText_px, 0, 200, height()), Qt::AlignVCenter | Qt::AlignLeft, word);
  const int x = kText_px + QFontMetrics(strong).horizontalAdvance(word) + 10;
  const int room = right - note_width - 16 - x;
  painter.setPen(p.text);
  FittedText words = fitText(text(), {body}, room, 1);
  if (!words.whole) words = fitText(text(), {small}, room, 2);
  paintFitted(painter, QRectF(x, 0, room, height()), Qt::AlignVCenter | Qt::AlignLeft, words);
}

}  // namespace kiln::gui
