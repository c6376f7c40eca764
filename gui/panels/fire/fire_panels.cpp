#include "gui/panels/fire/fire_panels.h"

#include "gui/panels/fire/aim_marks.h"
#include "gui/panels/fire/place_panel.h"
#include "gui/panels/fire/pump_panel.h"
#include "gui/panels/fire/thermal_tile.h"

namespace kiln::gui {

std::vector<PanelKind> firePanels() {
  PanelKind thermal{"fire.thermal"};
  thermal.image = [](const PanelParts& parts) -> QWidget* {
    return new ThermalTile(parts.ui, parts.models, parts.geometry);
  };
  PanelKind places{"fire.places"};
  places.scene = [](const PanelParts& parts, QWidget* parent) -> SceneCard* {
    return new PlacePanel(parts.ui, parts.models, parent);
  };
  PanelKind water{"fire.water"};
  water.hands = [](const PanelParts& parts) -> QWidget* {
    return new PumpPanel(parts.ui, parts.hold);
  };
  PanelKind aim{"fire.aim"};
  aim.marks = [](const PanelParts& parts) -> PictureMarks* { return new AimMarks(parts.models); };
  return {thermal, places, water, aim};
}

}  // namespace kiln::gui
