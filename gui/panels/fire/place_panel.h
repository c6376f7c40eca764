#pragma once

#include <vector>

#include "gui/panels/fire/place_nudge.h"
#include "gui/views/scene3d/scene_card.h"
#include "gui/widgets/banner.h"
#include "gui/widgets/hold_button.h"

namespace kiln::gui {

/// A fire place as configured and as sensed: the offset in words, small steps to move the
/// configured place, "take the sensed one", and to go on despite the check. Comes by itself when a
/// place is misplaced.
class PlacePanel : public SceneCard {
  Q_OBJECT
 public:
  static constexpr double kStep_m = 0.02;
  static constexpr double kStepYaw_rad = 0.0175;

  PlacePanel(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] QString keyText() const override { return tr("places"); }
  [[nodiscard]] QString keyTip() const override {
    return tr("fire places: configured against sensed, and to move one");
  }
  void toggle() override;
  bool open(const SceneItem& item) override;
  void cancel() override { nudge_.cancel(); }
  [[nodiscard]] std::vector<SceneItem> ghosts() const override;
  [[nodiscard]] std::optional<Eigen::Vector2d> subject() const override;
  [[nodiscard]] PlaceNudge& nudge() { return nudge_; }
  [[nodiscard]] HoldButton* moveButton() const { return move_; }
  [[nodiscard]] HoldButton* goOnButton() const { return go_on_; }
  [[nodiscard]] ActButton* sensedButton() const { return sensed_; }
  [[nodiscard]] QString text() const { return words_->text(); }

 private:
  void refresh();
  void refreshButtons();
  void restyle();
  void next();
  ActButton* step(const QString& text, const QString& tip, double dx, double dy, double dyaw);
  Ui ui_;
  StationModels& models_;
  PlaceNudge nudge_;
  ActButton *name_, *close_;
  Banner* words_;
  std::vector<ActButton*> steps_;
  ActButton *sensed_, *cancel_;
  HoldButton *move_, *go_on_;
  bool opened_ = false;
  QString closed_for_;  ///< the misplaced place for which the operator has closed the panel
};

}  // namespace kiln::gui
