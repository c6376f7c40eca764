#pragma once

#include <QPointer>

#include "gui/panels/panel.h"

class QHBoxLayout;

namespace kiln::gui {

class CameraTile;
class MacrosTile;
class SceneTile;

/// Puts the panels that the robot's mission names into the window, and takes them out again when it
/// names others. Ids that this station does not know are said in its log.
class MissionPanels : public QObject {
  Q_OBJECT
 public:
  struct Places {
    QHBoxLayout* images;
    SceneTile* scene;
    MacrosTile* macros;
    CameraTile* camera;
  };
  MissionPanels(const PanelParts& parts, const Places& places,
                const std::vector<PanelKind>& catalog, QObject* parent = nullptr);

 private:
  void refresh();
  void clear();
  void add(const PanelKind& kind);

  Ui ui_;
  StationModels& models_;
  HoldToRun& hold_;
  RobotGeometry geometry_;
  Places places_;
  const std::vector<PanelKind>& catalog_;
  std::vector<std::string> shown_;
  std::vector<QPointer<QWidget>> images_;
};

}  // namespace kiln::gui
