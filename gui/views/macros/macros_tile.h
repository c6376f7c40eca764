#pragma once

#include <vector>

#include "gui/views/macros/macro_row.h"
#include "gui/views/teleop/hold_to_run.h"
#include "gui/widgets/text.h"
#include "gui/widgets/tile.h"

namespace kiln::gui {

/// Macros, and what else a mission gives to the hands: everything runs only while a button is held.
class MacrosTile : public Tile {
  Q_OBJECT
 public:
  /// @param hold  the station's one HoldToRun, shared with the teleop tile; outlives this tile.
  MacrosTile(const Ui& ui, HoldToRun& hold, QWidget* parent = nullptr);
  ~MacrosTile() override;
  /// A panel of the mission under the macros; the tile owns it from now on. nullptr: none any more.
  void setHands(QWidget* panel);
  [[nodiscard]] const std::vector<MacroRow*>& rows() const { return rows_; }
  [[nodiscard]] QString note() const { return note_->text(); }

 private:
  void rebuildRows();
  void addRow(const MacroInfo& macro);
  void letGo();
  void refresh();
  void restyle();

  Ui ui_;
  HoldToRun& hold_;
  StationModels& models_;
  QVBoxLayout* list_;
  std::vector<MacroRow*> rows_;
  Label* note_;
  QVBoxLayout* column_;
  QWidget* hands_ = nullptr;
};

}  // namespace kiln::gui
