#include "gui/views/timeline/command_lane.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>

namespace kiln::gui {

namespace {
constexpr double kMarkRoom_px = 8.0;  // between a mark and any text
constexpr double kMark_px = 3.2;
// A name that stands before its mark keeps this far from an older one, which it could seem to name.
constexpr double kOthersMark_px = 30.0;

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

std::vector<CommandName> placeCommandNames(const std::vector<CommandMark>& marks, double left,
                                           double right) {
  std::vector<CommandName> out;
  double taken = right;  // marks and names of newer commands begin here
  for (std::size_t i = marks.size(); i-- > 0;) {
    const auto& [x, width] = marks[i];
    const double older = i > 0 ? marks[i - 1].x : left - kOthersMark_px;
    const double behind = x + kMarkRoom_px, before = x - kMarkRoom_px - width;
    if (behind + width <= taken) {
      out.push_back({i, behind});
      taken = x - kMarkRoom_px;
    } else if (before >= older + kOthersMark_px) {
      out.push_back({i, before});
      taken = before - kMarkRoom_px;
    } else {
      taken = std::min(taken, x - kMarkRoom_px);
    }
  }
  return out;
}

void paintCommandLane(QPainter& painter, const QRectF& area, const Theme& theme,
                      const std::deque<TrackedCommand>& commands,
                      const std::function<double(Stamp)>& x_of) {
  const Palette& p = theme.colors();
  const QFont font = theme.font(TextRole::Small);
  const auto color = [&](const TrackedCommand& command) {
    return command.bad() ? p.caution : command.open() ? p.dim : p.text;
  };
  std::vector<const TrackedCommand*> shown;
  std::vector<CommandMark> marks;
  for (const TrackedCommand& command : commands) {
    const double x = x_of(command.sent);
    if (x < area.left() - 4 || x > area.right() + 4) continue;
    shown.push_back(&command);
    marks.push_back({x, QFontMetricsF(font).horizontalAdvance(textOf(command)) + 1});
  }
  painter.save();
  painter.setFont(font);
  painter.setClipRect(area.adjusted(-8, 0, 8, 0));
  for (std::size_t i = 0; i < shown.size(); ++i)
    paintMark(painter, {marks[i].x, area.center().y()}, *shown[i], color(*shown[i]));
  for (const auto& [i, left] : placeCommandNames(marks, area.left(), area.right())) {
    painter.setPen(color(*shown[i]));
    painter.drawText(QRectF(left, area.top(), marks[i].name_px, area.height()),
                     Qt::AlignVCenter | Qt::AlignLeft, textOf(*shown[i]));
  }
  painter.restore();
}

}  // namespace kiln::gui
