#include "gui/views/timeline/command_lane.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>

namespace kiln::gui {

namespace {
constexpr double kMarkRoom_px = 8.0;  // between a mark and any text
constexpr double kMark_px = 3.2;

void paintMark(QPainter& painter, const QPointF& c, const TrackedCommand& command,
               const QColor& color) {
  painter.setPen(QPen(color, 1.6));
  if (command.bad()) {  // a cross: not only the colour tells
    painter.drawLine(c + QPointF(-3.5, -3.5), c + QPointF(3.5, 3.5));
    painter.drawLine(c + QPointF(-3.5, 3.5), c + QPointF(3.5, -3.5));
    return;
  }
  painter.setBrush(command.open() ? Qt::NoBrush : QBrush(color));
  painter.drawEllipse(c, kMark_px, kMark_px);
  painter.setBrush(Qt::NoBrush);
}

QString textOf(const TrackedCommand& command) {
  const bool well = command.state == CommandState::Done || command.state == CommandState::Accepted;
  return well ? command.label : command.label + QStringLiteral(" · ") + toText(command.state);
}
}  // namespace

void paintCommandLane(QPainter& painter, const QRectF& area, const Theme& theme,
                      const std::deque<TrackedCommand>& commands,
                      const std::function<double(Stamp)>& x_of) {
  const Palette& p = theme.colors();
  const QFont font = theme.font(TextRole::Small);
  painter.save();
  painter.setFont(font);
  painter.setClipRect(area.adjusted(-8, 0, 8, 0));
  double free_until = area.right();  // marks and texts of newer commands begin here
  for (auto it = commands.rbegin(); it != commands.rend(); ++it) {
    const double x = x_of(it->sent);
    if (x < area.left() - 4 || x > area.right() + 4) continue;
    const QColor color = it->bad() ? p.caution : it->open() ? p.dim : p.text;
    paintMark(painter, {x, area.center().y()}, *it, color);
    const QString text = textOf(*it);
    const double width = QFontMetricsF(font).horizontalAdvance(text) + 1;
    double left = x + kMarkRoom_px;
    if (left + width > free_until) {
      // No room to the right: to the left, and there beyond the marks of older commands.
      left = x - kMarkRoom_px - width;
      for (auto older = std::next(it); older != commands.rend(); ++older) {
        const double other = x_of(older->sent);
        if (other + kMarkRoom_px > left && other <= x) left = other - kMarkRoom_px - width;
      }
    }
    const bool fits = left + width <= free_until && left >= area.left();
    free_until = std::min(free_until, x - kMarkRoom_px);
    if (!fits) continue;
    painter.setPen(color);
    painter.drawText(QRectF(left, area.top(), width, area.height()),
                     Qt::AlignVCenter | Qt::AlignLeft, text);
    free_until = std::min(free_until, left - kMarkRoom_px);
  }
  painter.restore();
}

}  // namespace kiln::gui
