#pragma once

#include "gui/models/station_models.h"
#include "gui/views/scene3d/scene_canvas.h"
#include "gui/widgets/tile.h"

class QButtonGroup;

namespace kiln::gui {

class LayerPanel;

/// The 3D scene as a tile, fed by the models.
class SceneTile : public Tile {
  Q_OBJECT
 public:
  /// @param open_gl  openGlAvailable(); false draws the top view.
  SceneTile(const Ui& ui, StationModels& models, RobotGeometry geometry, bool open_gl,
            QWidget* parent = nullptr);
  [[nodiscard]] SceneCanvas& canvas() { return *canvas_; }
  [[nodiscard]] const SceneState& state() const { return state_; }
  /// Shows or hides the list of layers.
  void toggleLayerPanel();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void takeStatus();
  void takeAges();
  void refresh();
  QWidget* makeCameraButtons();
  void markCameraButton();

  Ui ui_;
  StationModels& models_;
  SceneState state_;
  SceneCanvas* canvas_;
  LayerPanel* layers_;
  bool panel_chosen_ = false;  ///< the operator has shown or hidden it
  QButtonGroup* camera_buttons_;
};

}  // namespace kiln::gui
