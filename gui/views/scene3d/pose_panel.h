#pragma once

#include <QFrame>

#include "gui/models/pose_placer.h"
#include "gui/widgets/banner.h"
#include "gui/widgets/hold_button.h"

namespace kiln::gui {

/// The card under a pose that is being set: what to do next, the figures, hold to confirm, cancel.
/// Stands at the bottom of the scene, away from the button that opened it. Hidden while idle.
class PosePanel : public QFrame {
  Q_OBJECT
 public:
  PosePanel(const Ui& ui, PosePlacer& placer, QWidget* parent = nullptr);
  [[nodiscard]] HoldButton* confirmButton() const { return confirm_; }
  [[nodiscard]] QString text() const { return words_->text(); }

 signals:
  void resized();

 private:
  void refresh();
  void restyle();
  Ui ui_;
  PosePlacer& placer_;
  Banner* words_;
  HoldButton* confirm_;
  ActButton* cancel_;
};

}  // namespace kiln::gui
