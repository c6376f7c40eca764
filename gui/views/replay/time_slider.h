#pragma once

#include <QWidget>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// A time line to drag: filled up to now, the time under the pointer above it.
class TimeSlider : public QWidget {
  Q_OBJECT
 public:
  explicit TimeSlider(const Ui& ui, QWidget* parent = nullptr);
  /// Seconds from the beginning. While it is dragged the handle stays under the pointer.
  void set(double position_s, double length_s);
  [[nodiscard]] double position() const { return position_s_; }
  [[nodiscard]] QSize sizeHint() const override { return {400, 34}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, 34}; }

 signals:
  void wanted(double position_s);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  [[nodiscard]] QRectF groove() const;
  [[nodiscard]] double xOf(double position_s) const;
  [[nodiscard]] double timeAt(double x) const;
  Ui ui_;
  double position_s_ = 0.0, length_s_ = 0.0;
  double hover_x_ = -1.0;
  bool dragging_ = false;
};

/// "01:23.4"; with hours when there are any.
[[nodiscard]] QString timeText(double seconds);

}  // namespace kiln::gui
