#pragma once

#include "gui/models/forced_jump.h"
#include "gui/models/station_models.h"
#include "gui/views/state_card/exit_list.h"
#include "gui/views/state_card/preflight_list.h"
#include "gui/views/state_card/tick_list.h"
#include "gui/widgets/banner.h"
#include "gui/widgets/hold_button.h"
#include "gui/widgets/tile.h"
#include "gui/widgets/word_stack.h"

namespace kiln::gui {

/// What the robot does now and why it waits: time in state, guards with the ages of their inputs,
/// the ways out as buttons (each through the forced jump's hold). NOT READY shows the checks and
/// what to do about those that fail; a protective stop shows its release.
class StateCard : public Tile {
  Q_OBJECT
 public:
  StateCard(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* parent = nullptr);
  [[nodiscard]] TickList* ticks() const { return ticks_; }
  [[nodiscard]] PreflightList* preflight() const { return preflight_; }
  [[nodiscard]] HoldButton* protectiveRelease() const { return release_; }
  [[nodiscard]] const std::vector<ActButton*>& exits() const { return exits_->buttons(); }
  [[nodiscard]] ExitList* exitList() const { return exits_; }
  /// Whatever it has to say: its neighbours stand still.
  [[nodiscard]] QSize sizeHint() const override { return {300, 300}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {260, 180}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  void refreshHeader(const FsmStatus& fsm);
  void refreshNotice();
  void refreshExits();
  [[nodiscard]] std::vector<TickList::Row> guardRows(const FsmStatus& fsm) const;
  Ui ui_;
  StationModels& models_;
  ForcedJump& jump_;
  Banner* notice_;
  Banner* display_;
  TickList* ticks_;
  PreflightList* preflight_;
  HoldButton* release_;
  ExitList* exits_;
  QString exits_of_;
};

}  // namespace kiln::gui
