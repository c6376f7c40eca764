#pragma once

#include <vector>

#include "gui/views/macros/macro_row.h"
#include "gui/views/macros/water_gauge.h"
#include "gui/views/teleop/hold_to_run.h"
#include "gui/widgets/text.h"
#include "gui/widgets/tile.h"

class QButtonGroup;

namespace kiln::gui {

/// Macros, pump and water: everything runs only while a button is held.
class MacrosTile : public Tile {
  Q_OBJECT
 public:
  /// @param hold  the station's one HoldToRun, shared with the teleop tile; outlives this tile.
  MacrosTile(const Ui& ui, HoldToRun& hold, QWidget* parent = nullptr);
  ~MacrosTile() override;
  [[nodiscard]] HoldButton& pump() { return *pump_; }
  [[nodiscard]] const std::vector<MacroRow*>& rows() const { return rows_; }
  [[nodiscard]] QString note() const { return note_->text(); }

 private:
  enum class Pumps { Both, Left, Right };
  void rebuildRows();
  void addRow(const MacroInfo& macro);
  void letGo();
  void refresh();
  void refreshPump();
  void refreshMacros();
  void beginPump();
  void endPump();
  void restyle();
  QWidget* makePump();
  [[nodiscard]] HoldPump pumpSetpoint() const;

  Ui ui_;
  HoldToRun& hold_;
  StationModels& models_;
  QVBoxLayout* list_;
  std::vector<MacroRow*> rows_;
  Label* note_;
  HoldButton* pump_;
  QButtonGroup* sides_;
  WaterGauge* water_;
  Pumps which_ = Pumps::Both;
  double sprayed_before_l_ = 0.0;  ///< mission total when this spray began
  Stamp spray_began_;
};

}  // namespace kiln::gui
