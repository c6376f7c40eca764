#pragma once

#include <QWidget>

#include "gui/models/station_models.h"
#include "gui/widgets/fitted_text.h"
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
  /// reason() as it is shown: in fewer words where there is no room for all; they are in the tip.
  [[nodiscard]] FittedText fittedReason() const;
  [[nodiscard]] QSize minimumSizeHint() const override { return {330, 46}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] QColor wordColor() const;
  double paintName(QPainter& painter);
  double paintChip(QPainter& painter, double x);
  Ui ui_;
  StationModels& models_;
  int reason_room_px_ = 0;  ///< behind the word, when it was painted last
};

}  // namespace kiln::gui
