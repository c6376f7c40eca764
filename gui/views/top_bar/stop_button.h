#pragma once

#include <QWidget>

#include "gui/models/stop_model.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// STOP (software): acts at the press, not at the release; dark red while clear, bright while
/// latched, grey with "NO LINK" when its lane has no peer (and still tries). An octagon, never red
/// on yellow: it is not an ISO 13850 emergency stop.
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
  Ui ui_;
  StopModel& stop_;
};

}  // namespace kiln::gui
