#pragma once

#include <QPainter>
#include <functional>
#include <vector>

#include "gui/link/run_history.h"
#include "gui/views/timeline/command_lane.h"
#include "gui/views/timeline/time_axis.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Draws lanes of the timeline. Holds references for the length of one paint.
class LanePainter {
 public:
  struct Curve {
    const HistorySeries& series;
    QColor color;
    double low = 0.0, high = 1.0;  ///< least range of the axis
    QString unit;
  };
  struct States {
    const std::vector<Visit>& visits;
    Stamp position;     ///< where the robot is in its run
    Stamp known_until;  ///< end of a visit that has not ended
    std::function<QString(const QString&)> label;
  };
  LanePainter(QPainter& painter, const Theme& theme, const TimeAxis& axis)
      : painter_(painter), theme_(theme), axis_(axis) {}

  void states(const QRectF& area, const States& states);
  void spans(const QRectF& area, const std::vector<HistorySpan>& spans);
  /// Bars by the worst of their time, seconds; NaN: no link.
  void link(const QRectF& area, const HistorySeries& rtt);
  void curve(const QRectF& area, const Curve& curve);
  void commands(const QRectF& area, const std::deque<TrackedCommand>& commands) {
    paintCommandLane(painter_, area, theme_, commands, [this](Stamp t) { return axis_.xOf(t); });
  }

 private:
  void bar(const QRectF& bar, const QString& text, const QColor& fill, const QColor& ink);
  void newest(const QRectF& area, const QString& text);
  QPainter& painter_;
  const Theme& theme_;
  const TimeAxis& axis_;
};

}  // namespace kiln::gui
