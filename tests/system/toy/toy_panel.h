#pragma once

#include "gui/panels/panel.h"

namespace kiln::toy {

/// A card with a key that sends the toy's one command.
[[nodiscard]] gui::PanelKind panel();

}  // namespace kiln::toy
