#pragma once

#include <QWidget>

#include "gui/models/station_models.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// KILN, the robot's name, LIVE / SIMULATOR / REPLAY, the one large word and why, or the current
/// state beside it.
class StatusBlock : public QWidget {
  Q_OBJECT
 public:
  StatusBlock(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] QString word() const;
  [[nodiscard]] QString reason() const;
  [[nodiscard]] QSize minimumSizeHint() const override { return {330, 46}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] QColor wordColor() const;
  double paintName(QPainter& painter);
  double paintChip(QPainter& painter, double x);
  Ui ui_;
  StationModels& models_;
};

}  // namespace kiln::gui
