#include "gui/views/top_bar/stop_button.h"

#include <QMouseEvent>
#include <QPainter>
#include <cmath>

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
  setToolTip(
      tr("Software stop (Space or Pause): robot ramps down, pumps off, magnets keep.\n"
         "It is not an emergency stop: that is the red mushroom on the robot."));
  setAccessibleName(tr("STOP (software)"));
  connect(&stop_, &Model::changed, this, qOverload<>(&QWidget::update));
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

QString StopButton::caption() const {
  switch (stop_.stage()) {
    case StopStage::Unreachable:
      return stop_.recorded() ? tr("recording") : tr("NO LINK");
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
  const bool dead = stage == StopStage::Unreachable;
  const bool lit = stage == StopStage::Sent || stop_.latched();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(lit ? QPen(p.text, 2) : QPen(Qt::NoPen));
  painter.setBrush(dead ? p.raised : lit ? p.stop_latched : p.stop_body);
  painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
  const QColor ink = dead ? p.dim : p.stop_text;
  painter.setPen(QPen(ink, 2.4));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolygon(octagon({23, height() / 2.0}, 13));
  painter.drawPolygon(octagon({23, height() / 2.0}, 5));
  painter.setPen(ink);
  QFont big = ui_.theme.font(TextRole::Value);
  big.setWeight(QFont::Bold);
  painter.setFont(big);
  painter.drawText(QRect(44, 4, width() - 46, 22), Qt::AlignLeft | Qt::AlignVCenter, tr("STOP"));
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.drawText(QRect(44, 25, width() - 46, 16), Qt::AlignLeft | Qt::AlignVCenter, caption());
}

void StopButton::mousePressEvent(QMouseEvent* event) {
  event->accept();
  stop_.press();
}

}  // namespace kiln::gui
