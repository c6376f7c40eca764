#pragma once

#include "gui/models/pose_placer.h"
#include "gui/models/station_models.h"
#include "gui/views/scene3d/clearance.h"
#include "gui/views/scene3d/scene_canvas.h"
#include "gui/views/scene3d/scene_card.h"
#include "gui/widgets/tile.h"

class QButtonGroup;
class QHBoxLayout;
class QToolButton;

namespace kiln::gui {

class LayerPanel;
class LocalizationChip;
class PoseChip;
class PosePanel;

/// The 3D scene as a tile, fed by the models.
class SceneTile : public Tile {
  Q_OBJECT
 public:
  /// @param open_gl  openGlAvailable(); false draws the top view.
  SceneTile(const Ui& ui, StationModels& models, RobotGeometry geometry, bool open_gl,
            QWidget* parent = nullptr);
  [[nodiscard]] SceneCanvas& canvas() { return *canvas_; }
  [[nodiscard]] const SceneState& state() const { return state_; }
  /// A card over the scene, child of the canvas, with a key in the header.
  void addCard(SceneCard* card);
  void removeCards();
  [[nodiscard]] const std::vector<SceneCard*>& cards() const { return cards_; }
  /// Shows or hides the list of layers.
  void toggleLayerPanel();
  [[nodiscard]] PosePlacer& posePlacer() { return placer_; }
  [[nodiscard]] PosePanel* posePanel() const { return pose_panel_; }
  [[nodiscard]] LocalizationChip* localizationChip() const { return chip_; }
  [[nodiscard]] PoseChip* poseChip() const { return figures_; }
  /// What is drawn and how old it is, "15 k points · live"; "live" only if it is.
  [[nodiscard]] QString headerText() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void takeMap();
  void takeIntent();
  void watchPlacing();
  void watchCards();
  void arrange();
  void refreshPoseButton();
  void takeStatus();
  void takeAges();
  void refresh();
  QWidget* makeCameraButtons();
  void markCameraButton();
  QToolButton* addTool(QHBoxLayout& row, const QString& text);

  Ui ui_;
  StationModels& models_;
  SceneState state_;
  ClearanceMeter clearance_;
  SceneCanvas* canvas_;
  LayerPanel* layers_;
  bool panel_chosen_ = false;  ///< the operator has shown or hidden it
  QButtonGroup* camera_buttons_;
  PosePlacer placer_;
  LocalizationChip* chip_;
  PoseChip* figures_;
  PosePanel* pose_panel_;
  std::vector<SceneCard*> cards_;
  QToolButton* pose_button_ = nullptr;
  QHBoxLayout* card_keys_ = nullptr;
  OrbitCamera::Mode before_placing_ = OrbitCamera::Mode::Follow;
  bool placing_ = false;
  std::optional<Eigen::Vector2d> looked_at_;  ///< subject that the camera was turned to
};

}  // namespace kiln::gui
