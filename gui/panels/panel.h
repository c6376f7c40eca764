#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/robot_model/robot_geometry.h"
#include "gui/models/station_models.h"
#include "gui/views/camera/picture_marks.h"
#include "gui/views/scene3d/scene_card.h"
#include "gui/views/teleop/hold_to_run.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// What the station lends a panel; all of it outlives the panel.
struct PanelParts {
  const Ui& ui;
  StationModels& models;
  HoldToRun& hold;
  const RobotGeometry& geometry;
};

/// Something that one mission adds to the window. It is shown while the robot's MissionInfo names
/// its id. Exactly one of the makers is set; it says where the panel stands.
struct PanelKind {
  std::string id;                                      ///< "fire.places"
  std::function<QWidget*(const PanelParts&)> image{};  ///< a tile in the row of pictures
  std::function<SceneCard*(const PanelParts&, QWidget* parent)> scene{};  ///< a card over the scene
  std::function<QWidget*(const PanelParts&)> hands{};       ///< under the macros: controls to hold
  std::function<PictureMarks*(const PanelParts&)> marks{};  ///< in the cameras' pictures
};

}  // namespace kiln::gui
