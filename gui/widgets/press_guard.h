#pragma once

#include <QObject>
#include <QPoint>
#include <QPointer>
#include <QString>
#include <QWidget>

namespace kiln::gui {

/// Watches one press of a control that acts while it is held, until it is over. Tells of the
/// release wherever it happens and of everything after which nobody can say that the control is
/// still held: a mouse event without the button, the keyboard or the window gone, a dialog, the
/// control hidden, locked, moved within its window or taken out of it. GUI thread only.
class PressGuard : public QObject {
  Q_OBJECT
 public:
  explicit PressGuard(QWidget& control);
  ~PressGuard() override;
  /// @param by_mouse  else by a key, whose release the control sees itself.
  void begin(bool by_mouse);
  /// The control knows by itself that it is over.
  void end() { watching_ = false; }
  [[nodiscard]] bool watching() const { return watching_; }

 signals:
  void over();  ///< once a press

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void finish();
  [[nodiscard]] bool ends(QObject* watched, const QEvent& event) const;
  [[nodiscard]] bool moved() const;
  QWidget& control_;
  QPointer<QWidget> window_;
  QPoint place_;  ///< of the control in its window when it was pressed
  QSize size_;
  bool watching_ = false, by_mouse_ = false, had_focus_ = false;
};

}  // namespace kiln::gui
