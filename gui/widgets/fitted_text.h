#pragma once

#include <QFont>
#include <QStringList>
#include <vector>

class QPainter;
class QRectF;

namespace kiln::gui {

/// A text broken into lines for a given room. What an operator must read is wrapped or set
/// narrower, not cut: only what fits in no way loses its end ("…"), and `whole` then says so.
struct FittedText {
  QFont font;
  QStringList lines;
  int line_px = 0;  ///< height of a line
  bool whole = true;
  [[nodiscard]] int height() const { return line_px * static_cast<int>(lines.size()); }
};

/// The same height, narrower: what does not fit becomes condensed, never lower than can be read.
[[nodiscard]] QFont condensed(QFont font, int percent);

/// @param fonts      first choice first; at least one.
/// @param max_lines  at least 1.
/// @return the text in the first font in which all of it fits into `width_px` and `max_lines`.
///         Breaks at spaces; a word wider than the room counts as not fitting.
[[nodiscard]] FittedText fitText(const QString& text, const std::vector<QFont>& fonts, int width_px,
                                 int max_lines);

/// Inside `area`, by `alignment` (horizontal and vertical), in the painter's pen.
void paintFitted(QPainter& painter, const QRectF& area, int alignment, const FittedText& text);

}  // namespace kiln::gui
