#pragma once

#include <QWidget>

#include "gui/models/station_models.h"
#include "gui/views/scene3d/clearance.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Where the base stands, how fast it moves and what is nearest to it, in figures: what a driver by
/// hand reads. Of one size whatever the figures; dashes for what is not known any more.
class PoseChip : public QWidget {
  Q_OBJECT
 public:
  PoseChip(const Ui& ui, const StationModels& models, QWidget* parent = nullptr);
  void show(const std::optional<Clearance>& clearance);
  [[nodiscard]] QString pose() const;   ///< "x +1.23 m  y −0.40 m  yaw +12°", in map
  [[nodiscard]] QString drive() const;  ///< "0.35 m/s · nearest 0.62 m ahead left"
  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] bool near() const;
  Ui ui_;
  const StationModels& models_;
  std::optional<Clearance> clearance_;
};

}  // namespace kiln::gui
