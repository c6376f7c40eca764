#include "gui/widgets/hatch.h"

namespace kiln::gui {

void paintHatch(QPainter& painter, const QRectF& rect, const QColor& color, double spacing_px,
                double width_px) {
  painter.save();
  painter.setClipRect(rect, Qt::IntersectClip);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(color, width_px, Qt::SolidLine, Qt::FlatCap));
  for (double x = rect.left() - rect.height(); x < rect.right() + spacing_px; x += spacing_px) {
    painter.drawLine(QPointF(x, rect.bottom() + width_px),
                     QPointF(x + rect.height(), rect.top() - width_px));
  }
  painter.restore();
}

}  // namespace kiln::gui
