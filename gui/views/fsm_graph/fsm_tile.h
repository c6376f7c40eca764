#pragma once

#include "gui/models/forced_jump.h"
#include "gui/models/station_models.h"
#include "gui/widgets/tile.h"

class QLineEdit;

namespace kiln::gui {

class ActButton;
class GraphView;
class JumpPanel;

/// The left column: graph, legend, mission buttons, forced jump.
class FsmTile : public Tile {
  Q_OBJECT
 public:
  FsmTile(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* parent = nullptr);
  [[nodiscard]] GraphView* graph() const { return graph_; }
  [[nodiscard]] JumpPanel* panel() const { return panel_; }
  void beginSearch();  ///< the '/' key
  void endSearch();

 private:
  void refresh();
  StationModels& models_;
  GraphView* graph_;
  JumpPanel* panel_;
  QLineEdit* search_;
};

}  // namespace kiln::gui
