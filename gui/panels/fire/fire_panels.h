#pragma once

#include "gui/panels/panel.h"

namespace kiln::gui {

/// Thermal picture with what was taken for the fire, fire places over the scene, pumps and water,
/// the jet's aim in the pictures.
[[nodiscard]] std::vector<PanelKind> firePanels();

}  // namespace kiln::gui
