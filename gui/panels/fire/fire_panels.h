#pragma once

#include "gui/panels/panel.h"

namespace kiln::gui {

/// Thermal picture with what was taken for the fire, fire places over the scene, pumps and water.
[[nodiscard]] std::vector<PanelKind> firePanels();

}  // namespace kiln::gui
