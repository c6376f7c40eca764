#include "gui/app/panel_catalog.h"

#include "gui/panels/fire/fire_panels.h"

namespace kiln::gui {

const std::vector<PanelKind>& panelCatalog() {
  static const std::vector<PanelKind> kPanels = [] {
    std::vector<PanelKind> all;
    for (const auto& panels : {firePanels()}) all.insert(all.end(), panels.begin(), panels.end());
    return all;
  }();
  return kPanels;
}

}  // namespace kiln::gui
