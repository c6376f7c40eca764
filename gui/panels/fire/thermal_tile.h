#pragma once

#include "common/robot_model/robot_geometry.h"
#include "gui/models/station_models.h"
#include "gui/panels/fire/aim_marks.h"
#include "gui/panels/fire/heat_model.h"
#include "gui/panels/fire/thermal_view.h"
#include "gui/widgets/text.h"
#include "gui/widgets/tile.h"

class QToolButton;

namespace kiln::gui {

/// The thermal camera as a tile: picture, scale, peak in large digits, what was taken for the fire
/// and what not.
class ThermalTile : public Tile {
  Q_OBJECT
 public:
  /// @param geometry  tells where the camera looks; without it the jet's aim is not marked.
  ThermalTile(const Ui& ui, StationModels& models,
              const std::optional<RobotGeometry>& geometry = {}, QWidget* parent = nullptr);
  [[nodiscard]] ThermalView& view() { return *view_; }
  /// Why the picture must not be read, in one sentence; empty if it may.
  [[nodiscard]] QString refusal() const;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  void refreshAge();
  void describe();
  [[nodiscard]] std::vector<PlacedMark> placedMarks() const;
  void restyle();
  void nameScale();
  QWidget* makeColumn();

  Ui ui_;
  StationModels& models_;
  HeatModel heat_;
  AimMarks aim_;
  std::optional<RobotGeometry> geometry_;
  ThermalView* view_;
  Label *peak_caption_, *peak_, *box_, *rejected_, *reading_;
  QToolButton* scale_;
  QWidget* column_ = nullptr;
};

}  // namespace kiln::gui
