#pragma once

#include <QColor>
#include <QPainter>
#include <QRectF>

namespace kiln::gui {

/// Diagonal stripes over `rect`, clipped to it: the sign for "do not trust what you see here".
void paintHatch(QPainter& painter, const QRectF& rect, const QColor& color,
                double spacing_px = 22.0, double width_px = 5.0);

}  // namespace kiln::gui
