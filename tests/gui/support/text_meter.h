#pragma once

#include <QString>

class QWidget;

namespace kiln::gui {

struct SmallestText {
  double points = 1e9;
  QString text;   ///< that is so small
  int texts = 0;  ///< painted in all
};

/// Paints `widget` with its children and looks at every text as it goes to the paint engine, in
/// points of the screen (a painter may be scaled). Texts in ready pictures are not seen.
[[nodiscard]] SmallestText smallestText(QWidget& widget);

/// All texts that `widget` with its children paints, in the order of painting: what can be read on
/// the screen.
[[nodiscard]] QString paintedText(QWidget& widget);

}  // namespace kiln::gui
