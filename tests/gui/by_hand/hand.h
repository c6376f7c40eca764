#pragma once

#include <QString>
#include <QWidget>
#include <functional>

#include "tests/gui/support/x_pointer.h"

namespace kiln::gui {

/// An operator's hand and eyes at the window: presses what is found by the words on it, through the
/// X server, and reads what is painted. Everything takes as long as a hand takes; the window goes on
/// meanwhile.
class Hand {
 public:
  explicit Hand(QWidget& window) : window_(window) {}
  ~Hand() { letGo(); }
  /// Lets the window work until `seen` or the time is over.
  bool waitFor(double seconds, const std::function<bool()>& seen);
  void look(double seconds);
  /// The button with these words on it that is to be seen and not dark; nullptr: there is none.
  [[nodiscard]] QWidget* button(const QString& words) const;
  bool click(const QString& words);
  /// Presses for so long.
  bool hold(const QString& words, double seconds);
  /// Presses until told; false if it cannot be pressed.
  bool holdUntil(const QString& words, double limit_s, const std::function<bool()>& done);
  /// Drags from one place of a widget to another.
  void drag(QWidget& widget, const QPoint& from, const QPoint& to);
  void key(char letter, bool down);
  void letGo();
  [[nodiscard]] bool presses() const { return !down_.isEmpty(); }  ///< a key

  /// All that the first widget of this class in the window paints; empty if it is not to be seen.
  template <class Widget>
  [[nodiscard]] QString read() const {
    for (Widget* widget : window_.findChildren<Widget*>())
      if (widget->isVisible()) return painted(*widget);
    return {};
  }

 private:
  [[nodiscard]] static QString painted(QWidget& widget);
  void pointAt(const QPoint& global);
  QWidget& window_;
  XPointer x_;
  QPoint at_;
  QString down_;  ///< keys
};

}  // namespace kiln::gui
