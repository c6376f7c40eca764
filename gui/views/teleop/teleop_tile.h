#pragma once

#include "gui/views/teleop/hold_to_run.h"
#include "gui/views/teleop/jog_panel.h"
#include "gui/widgets/fitted_label.h"
#include "gui/widgets/hold_button.h"
#include "gui/widgets/text.h"
#include "gui/widgets/tile.h"

class QSlider;
class QStackedWidget;

namespace kiln::gui {

/// Taking over: into Teleop and back, the sticks, the speed. Says why the sticks are locked.
class TeleopTile : public Tile {
  Q_OBJECT
 public:
  /// @param hold  the station's one HoldToRun, shared with the macro and pump tile; outlives this
  /// tile.
  TeleopTile(const Ui& ui, HoldToRun& hold, QWidget* parent = nullptr);
  ~TeleopTile() override;
  [[nodiscard]] JogPanel& panel() { return *panel_; }
  /// Why the sticks do nothing; empty when they are live.
  [[nodiscard]] QString lockReason() const;

 private:
  void enterTeleop();
  void returnToAutonomy();
  void refresh();
  void refreshMode();
  void sendSpeed();
  void restyle();
  QWidget* makeSide();

  Ui ui_;
  HoldToRun& hold_;
  StationModels& models_;
  JogPanel* panel_;
  ActButton* enter_;
  HoldButton* leave_;
  QStackedWidget* modes_;
  FittedLabel* state_;
  Label *speed_caption_, *speed_text_;
  QSlider* speed_;
  QTimer speed_timer_;
  QString trip_;  ///< why the last hold ended by force
  Stamp tripped_at_;
};

}  // namespace kiln::gui
