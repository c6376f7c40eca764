#pragma once

#include <QWidget>

#include "gui/models/stop_model.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// STOP (software): acts at the press, not at the release; dark red while clear, bright while
/// latched. While the robot is not heard it takes presses all the same, but must not look like a
/// stop that works: grey ground, a red octagon, an amber band "NO LINK", and StopNote beside it. An
/// octagon, never red on yellow: it is not an ISO 13850 emergency stop.
class StopButton : public QWidget {
  Q_OBJECT
 public:
  StopButton(const Ui& ui, StopModel& stop, QWidget* parent = nullptr);
  [[nodiscard]] QString caption() const;
  [[nodiscard]] QSize sizeHint() const override { return {124, 46}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  void paintCaption(QPainter& painter, const QColor& ink, bool unheard) const;
  Ui ui_;
  StopModel& stop_;
};

/// Beside the key while the robot is not heard: what a press does now, and what to do instead.
/// Hidden while the key works.
class StopNote : public QWidget {
  Q_OBJECT
 public:
  StopNote(const Ui& ui, StopModel& stop, QWidget* parent = nullptr);
  [[nodiscard]] QString text() const;
  [[nodiscard]] QSize sizeHint() const override { return {272, 46}; }
  void refresh();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Ui ui_;
  StopModel& stop_;
};

}  // namespace kiln::gui
