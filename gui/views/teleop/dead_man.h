#pragma once

#include <QObject>
#include <QPointer>

class QWidget;

namespace kiln::gui {

class HoldToRun;

/// Lets go of everything that is held as soon as the operator's attention may be elsewhere: the
/// window loses the keyboard, another program comes to the front or the screen locks, a dialog
/// opens, the panel is hidden, disabled or gone, the keyboard focus leaves the panel.
class DeadMan : public QObject {
  Q_OBJECT
 public:
  /// @param panel  the widget with the controls; may be shown in a window later.
  DeadMan(HoldToRun& hold, QWidget& panel);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void trip(const QString& why);
  void focusMoved(QWidget* from, QWidget* to);
  HoldToRun& hold_;
  QPointer<QWidget> panel_;
};

}  // namespace kiln::gui
