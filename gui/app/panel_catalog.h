#pragma once

#include "gui/panels/panel.h"

namespace kiln::gui {

/// The panels of all missions that this station knows; the only file of gui/ outside gui/panels
/// that names missions. To add one: a folder in gui/panels, and a line here.
[[nodiscard]] const std::vector<PanelKind>& panelCatalog();

}  // namespace kiln::gui
