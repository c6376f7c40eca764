#pragma once

#include <QStackedWidget>

#include "gui/models/forced_jump.h"
#include "gui/models/station_models.h"
#include "gui/widgets/banner.h"
#include "gui/widgets/hold_button.h"

namespace kiln::gui {

/// Under the graph: words, then start / pause / resume, and the forced jump from arming to the
/// robot's answer. Its height never changes. The hold that jumps stands where "Pause" was, never
/// under the button that armed it.
class JumpPanel : public QWidget {
  Q_OBJECT
 public:
  /// @param legend  stands where the question stands while a jump is asked for. Takes ownership.
  JumpPanel(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* legend,
            QWidget* parent = nullptr);
  [[nodiscard]] HoldButton* armButton() const { return arm_; }
  [[nodiscard]] HoldButton* jumpButton() const { return confirm_; }
  [[nodiscard]] HoldButton* startButton() const { return start_; }
  [[nodiscard]] ActButton* pauseButton() const { return pause_; }

 private:
  void refresh();
  void refreshMission();
  [[nodiscard]] QString startLock() const;
  [[nodiscard]] QString resumeLock() const;
  void pauseOrResume();
  Ui ui_;
  StationModels& models_;
  ForcedJump& jump_;
  QStackedWidget *words_, *rows_;
  HoldButton* start_;
  ActButton* pause_;
  HoldButton* arm_;
  Banner* card_;
  HoldButton* confirm_;
  ActButton* cancel_;
  Banner* message_;
};

}  // namespace kiln::gui
