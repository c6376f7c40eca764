#pragma once

#include <QColor>
#include <QPointF>
#include <QString>

#include "common/model/status.h"
#include "gui/widgets/theme.h"

class QPainter;

namespace kiln::gui {

/// "Note", "Caution", "WARNING".
[[nodiscard]] QString levelWord(AlarmLevel level);
/// Of what stands; an alarm that is over is grey.
[[nodiscard]] QColor alarmColor(const Palette& colors, const Alarm& alarm);
/// The level by shape: a disc, a triangle, a square on its corner.
void paintAlarmMark(QPainter& painter, const QPointF& center, AlarmLevel level,
                    const QColor& color);

}  // namespace kiln::gui
