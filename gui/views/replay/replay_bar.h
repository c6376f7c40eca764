#pragma once

#include <QWidget>
#include <vector>

#include "gui/link/replay_link.h"
#include "gui/widgets/act_button.h"

namespace kiln::gui {

class TimeSlider;

/// The purple bar of a replay: what is played, where, how fast, and the controls. Keys: P plays and
/// pauses, comma and full stop step, [ and ] change the speed.
class ReplayBar : public QWidget {
  Q_OBJECT
 public:
  static constexpr double kStep_s = 0.1;
  static constexpr double kJump_s = 10.0;

  ReplayBar(const Ui& ui, ReplayLink& link, QWidget* parent = nullptr);
  [[nodiscard]] TimeSlider* slider() const { return slider_; }
  [[nodiscard]] ActButton* playButton() const { return play_; }
  void togglePlaying();
  void changeSpeed(int notches);  ///< +1: the next faster one
  void step(double seconds);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void show(const Playback& playback);
  ActButton* button(const QString& text, const QString& tip, int width);
  [[nodiscard]] QString title() const;
  Ui ui_;
  ReplayLink& link_;
  Playback playback_;
  ActButton *back_, *step_back_, *play_, *step_on_, *forward_, *slower_, *faster_;
  TimeSlider* slider_;
};

}  // namespace kiln::gui
