#include "gui/widgets/fitted_text.h"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

namespace kiln::gui {

namespace {
/// Greedy: as many words a line as go in. A word that is too wide has a line of its own.
QStringList broken(const QString& text, const QFontMetrics& metrics, int width_px) {
  QStringList lines;
  for (const QString& word : text.split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    const QString longer = lines.isEmpty() ? word : lines.constLast() + QLatin1Char(' ') + word;
    if (!lines.isEmpty() && metrics.horizontalAdvance(longer) <= width_px)
      lines.last() = longer;
    else
      lines << word;
  }
  return lines;
}

bool fits(const QStringList& lines, const QFontMetrics& metrics, int width_px, int max_lines) {
  return lines.size() <= max_lines &&
         std::all_of(lines.begin(), lines.end(), [&](const QString& line) {
           return metrics.horizontalAdvance(line) <= width_px;
         });
}
}  // namespace

QFont condensed(QFont font, int percent) {
  font.setStretch(percent);
  return font;
}

FittedText fitText(const QString& text, const std::vector<QFont>& fonts, int width_px,
                   int max_lines) {
  FittedText out;
  for (const QFont& font : fonts) {
    const QFontMetrics metrics(font);
    out = {font, broken(text, metrics, width_px), metrics.height(), true};
    if (fits(out.lines, metrics, width_px, max_lines)) return out;
  }
  out.whole = false;
  const QFontMetrics metrics(out.font);
  if (out.lines.size() > max_lines) {
    const QStringList rest = out.lines.mid(max_lines - 1);
    out.lines = out.lines.mid(0, max_lines - 1);
    out.lines << rest.join(QLatin1Char(' '));
  }
  for (QString& line : out.lines) line = metrics.elidedText(line, Qt::ElideRight, width_px);
  return out;
}

void paintFitted(QPainter& painter, const QRectF& area, int alignment, const FittedText& text) {
  painter.setFont(text.font);
  const double free = area.height() - text.height();
  double y = area.top() + (alignment & Qt::AlignBottom    ? free
                           : alignment & Qt::AlignVCenter ? free / 2
                                                          : 0.0);
  for (const QString& line : text.lines) {
    painter.drawText(QRectF(area.left(), y, area.width(), text.line_px),
                     (alignment & Qt::AlignHorizontal_Mask) | Qt::AlignVCenter | Qt::TextDontClip,
                     line);
    y += text.line_px;
  }
}

}  // namespace kiln::gui
