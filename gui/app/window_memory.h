#pragma once

#include <QSettings>
#include <QWidget>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// How the window was left, kept in the operator's settings. What cannot be read, or was not
/// written by it, counts as nothing.
class WindowMemory {
 public:
  /// @param file  empty: the operator's settings; tests name one.
  explicit WindowMemory(const QString& file = {});
  [[nodiscard]] ThemeKind theme() const;
  /// Within the screen that it comes up on, title bar and frame included; maximised where it would
  /// fill it anyhow. @param wanted  empty: as it was left.
  void place(QWidget& window, const QSize& wanted) const;
  /// Of TileLayout, as they were left.
  [[nodiscard]] QString choices() const;
  void keep(const QWidget& window, ThemeKind theme, const QString& choices);

 private:
  QSettings settings_;
};

}  // namespace kiln::gui
