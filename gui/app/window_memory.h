#pragma once

#include <QSettings>
#include <QWidget>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// How the window was left, kept in the operator's settings.
class WindowMemory {
 public:
  /// @param file  empty: the operator's settings; tests name one.
  explicit WindowMemory(const QString& file = {});
  [[nodiscard]] ThemeKind theme() const;
  /// Within the screen that it comes up on, title bar and frame included; maximised where it would
  /// fill it anyhow. @param wanted  empty: as it was left.
  void place(QWidget& window, const QSize& wanted) const;
  void keep(const QWidget& window, ThemeKind theme);

 private:
  QSettings settings_;
};

}  // namespace kiln::gui
