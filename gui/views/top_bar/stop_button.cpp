#include "gui/views/top_bar/stop_button.h"

#include <QMouseEvent>
#include <QPainter>
#include <cmath>

#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
QPolygonF octagon(const QPointF& centre, double radius) {
  QPolygonF shape;
  for (int i = 0; i < 8; ++i) {
    const double a = M_PI / 8 + i * M_PI / 4;
    shape << centre + radius * QPointF(std::cos(a), std::sin(a));
  }
  return shape;
}
}  // namespace

StopButton::StopButton(const Ui& ui, StopModel& stop, QWidget* parent)
    : QWidget(parent), ui_(ui), stop_(stop) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  setCursor(Qt::PointingHandCursor);
  setTip(*this, tr("Software stop (Space or Pause): robot ramps down, pumps off, magnets keep.\n"
                   "It is not an emergency stop: that is the red mushroom on the robot."));
  setAccessibleName(tr("STOP (software)"));
  connect(&stop_, &Model::changed, this, qOverload<>(&QWidget::update));
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

QString StopButton::caption() const {
  switch (stop_.stage()) {
    case StopStage::Unreachable:
      return stop_.recorded() ? tr("recording") : tr("NO LINK");
    case StopStage::Kept:
      return tr("kept, no link");
    case StopStage::Clear:
      return tr("software");
    case StopStage::Sent:
      return tr("sent …");
    case StopStage::Latched:
      return tr("latched");
    case StopStage::Standstill:
      return tr("standstill ✓");
  }
  return {};
}

void StopButton::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  const StopStage stage = stop_.stage();
  const bool recorded = stop_.recorded();
  const bool unheard = !recorded && (stage == StopStage::Unreachable || stage == StopStage::Kept);
  const bool lit = stage == StopStage::Sent || stage == StopStage::Kept || stop_.latched();
  const bool red = !unheard && !recorded;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(recorded  ? QPen(p.border, 1.2)
                 : unheard ? QPen(p.stop_latched, 2.4)
                 : lit     ? QPen(p.text, 2)
                           : QPen(Qt::NoPen));
  painter.setBrush(!red ? p.raised : lit ? p.stop_latched : p.stop_body);
  painter.drawRoundedRect(QRectF(rect()).adjusted(1.2, 1.2, -1.2, -1.2), 4, 4);
  const QColor ink = recorded ? p.faint : red ? p.stop_text : p.text;
  const QPointF mark(23, height() / 2.0);
  painter.setPen(unheard ? QPen(p.stop_text, 1.6) : QPen(ink, 2.4));
  painter.setBrush(unheard ? QBrush(lit ? p.stop_latched : p.stop_body) : QBrush(Qt::NoBrush));
  painter.drawPolygon(octagon(mark, unheard ? 15 : 13));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(unheard ? p.stop_text : ink, 2.4));
  painter.drawPolygon(octagon(mark, 5));
  painter.setPen(ink);
  QFont big = ui_.theme.font(TextRole::Value);
  big.setWeight(QFont::Bold);
  painter.setFont(big);
  painter.drawText(QRect(44, 4, width() - 46, 22), Qt::AlignLeft | Qt::AlignVCenter, tr("STOP"));
  paintCaption(painter, ink, unheard);
}

void StopButton::paintCaption(QPainter& painter, const QColor& ink, bool unheard) const {
  const Palette& p = ui_.theme.colors();
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(unheard ? p.caution : ink);
  painter.drawText(QRect(44, 25, width() - 46, 16), Qt::AlignLeft | Qt::AlignVCenter, caption());
}

void StopButton::mousePressEvent(QMouseEvent* event) {
  event->accept();
  stop_.press();
}

StopNote::StopNote(const Ui& ui, StopModel& stop, QWidget* parent)
    : QWidget(parent), ui_(ui), stop_(stop) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  refresh();
}

QString StopNote::text() const {
  if (stop_.recorded()) return {};
  switch (stop_.stage()) {
    case StopStage::Unreachable:
      return tr(
          "Use the robot's red button. A press here is kept and sent once the robot is heard.");
    case StopStage::Kept:
      return tr(
          "The robot has NOT got it: use its red button. Sent as soon as the robot is heard.");
    default:
      return {};
  }
}

void StopNote::refresh() {
  const bool shown = !text().isEmpty();
  if (shown == isHidden()) setVisible(shown);
  setTip(*this, text());
  update();
}

void StopNote::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.fillRect(rect(), p.caution_fill);
  painter.fillRect(QRect(width() - 4, 0, 4, height()), p.caution);
  painter.setPen(p.text);
  const QFont small = ui_.theme.font(TextRole::Small);
  paintFitted(painter, QRectF(rect()).adjusted(7, 0, -9, 0), Qt::AlignLeft | Qt::AlignVCenter,
              fitText(text(), {small, condensed(small, 92)}, width() - 16, 2));
}

}  // namespace kiln::gui
