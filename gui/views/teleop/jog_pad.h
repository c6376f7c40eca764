#pragma once

#include <QPointF>
#include <QWidget>

#include "gui/widgets/press_guard.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Where a virtual stick stands: x to the right, y up, each -1..1 and together at most 1 long.
/// Inside the dead zone it is exactly zero, from there it grows from zero, so that no step is felt.
/// @param offset_px  of the mouse from the middle, y down as on screens.
[[nodiscard]] QPointF stickValue(const QPointF& offset_px, double radius_px, double dead_zone);

/// A virtual stick: press and drag, release is stop, wherever it happens (PressGuard). Springs back
/// to the middle by itself.
class JogPad : public QWidget {
  Q_OBJECT
 public:
  enum class Axes { Both, Horizontal, Vertical };
  static constexpr double kDeadZone = 0.1;

  JogPad(const Ui& ui, Axes axes, QWidget* parent = nullptr);
  [[nodiscard]] QPointF value() const { return value_; }
  [[nodiscard]] bool pressed() const { return pressed_; }
  /// Back to the middle, as a release would, without a signal.
  void rest();
  /// What the keyboard does to the same axes, drawn as the stick's place.
  void setShown(const QPointF& value);
  /// Words at the ends: right, left, up, down; empty where there is no axis.
  void setEnds(const QString& right, const QString& left, const QString& up, const QString& down);
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 signals:
  void moved(const QPointF& value);  ///< also (0, 0) at the release
  void taken();                      ///< the mouse took hold

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  void follow(const QPointF& mouse);
  void letGo();
  [[nodiscard]] double radius() const;
  void paintStick(QPainter& painter, const QPointF& middle, double travel, bool live) const;
  void paintEnds(QPainter& painter) const;

  Ui ui_;
  PressGuard guard_;
  Axes axes_;
  QPointF value_, shown_;
  bool pressed_ = false;
  QString right_, left_, up_, down_;
};

}  // namespace kiln::gui
