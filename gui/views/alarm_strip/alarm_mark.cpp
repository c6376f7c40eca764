#include "gui/views/alarm_strip/alarm_mark.h"

#include <QPainter>

namespace kiln::gui {

QString levelWord(AlarmLevel level) {
  switch (level) {
    case AlarmLevel::Advisory:
      return QObject::tr("Note");
    case AlarmLevel::Caution:
      return QObject::tr("Caution");
    case AlarmLevel::Warning:
      return QObject::tr("WARNING");
  }
  return {};
}

QColor alarmColor(const Palette& colors, const Alarm& alarm) {
  if (!alarm.active) return colors.dim;
  return alarm.level == AlarmLevel::Warning   ? colors.fault
         : alarm.level == AlarmLevel::Caution ? colors.caution
                                              : colors.text;
}

void paintAlarmMark(QPainter& painter, const QPointF& c, AlarmLevel level, const QColor& color) {
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  switch (level) {
    case AlarmLevel::Warning:
      painter.drawPolygon(QPolygonF() << c + QPointF(0, -8) << c + QPointF(8, 0)
                                      << c + QPointF(0, 8) << c + QPointF(-8, 0));
      break;
    case AlarmLevel::Caution:
      painter.drawPolygon(QPolygonF()
                          << c + QPointF(0, -7) << c + QPointF(8, 6) << c + QPointF(-8, 6));
      break;
    case AlarmLevel::Advisory:
      painter.drawEllipse(c, 5, 5);
      break;
  }
}

}  // namespace kiln::gui
