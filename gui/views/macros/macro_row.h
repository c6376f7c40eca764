#pragma once

#include "common/model/status.h"
#include "gui/widgets/hold_button.h"

namespace kiln::gui {

/// One macro: name, what it takes, and a button that runs it while held. While it runs the bar is
/// the robot's own progress, not a guess of the station. The row goes on where the macro was let go
/// of; the small key beside it begins anew.
class MacroRow : public HoldButton {
  Q_OBJECT
 public:
  MacroRow(const Ui& ui, MacroInfo macro, QWidget* parent = nullptr);
  [[nodiscard]] const MacroInfo& macro() const { return macro_; }
  /// What the robot says of the running macro; another macro's status shows nothing here.
  void setStatus(const MacroStatus& status);
  /// Text at the right end: "hold to run", "locked".
  void setHint(const QString& hint);
  /// Runs it from its first step while held. Stands beside the row in the layout of its owner.
  [[nodiscard]] HoldButton& restart() { return *restart_; }
  /// The second line: what runs now, else the summary.
  [[nodiscard]] QString line() const { return step_.isEmpty() ? summary(macro_) : step_; }
  [[nodiscard]] QSize sizeHint() const override;
  /// "18 s · est. 0.9 l · start within 5 cm".
  [[nodiscard]] static QString summary(const MacroInfo& macro);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  MacroInfo macro_;
  HoldButton* restart_;
  double progress_ = 0.0;
  QString step_, hint_;
};

}  // namespace kiln::gui
