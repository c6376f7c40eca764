#pragma once

#include <QWidget>

#include "gui/models/station_models.h"
#include "gui/widgets/figure.h"
#include "gui/widgets/hold_button.h"

namespace kiln::gui {

class LeaseChip;
class StatusBlock;
class StopButton;
class StopNote;

/// 48 px at the top of the window, never covered: who, what state, who commands, link, energy,
/// clock, the mission's own figures, STOP.
class TopBar : public QWidget {
  Q_OBJECT
 public:
  TopBar(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] QStringList missionFigures() const;  ///< what they show
  [[nodiscard]] LeaseChip* leaseChip() const { return lease_; }
  [[nodiscard]] StopButton* stopButton() const { return stop_; }
  [[nodiscard]] StopNote* stopNote() const { return stop_note_; }
  [[nodiscard]] HoldButton* clearButton() const { return clear_; }
  [[nodiscard]] StatusBlock* statusBlock() const { return status_; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void refresh();
  void refreshLink();
  /// Those figures of the mission that belong here.
  void makeMissionFigures();
  void refreshMission(const RobotStatus& status, AgeLevel shown);
  /// Narrow bars leave out what matters least; nothing but the width decides where a key stands.
  void arrange();
  Ui ui_;
  StationModels& models_;
  StatusBlock* status_;
  LeaseChip* lease_;
  gui::Figure *link_, *age_, *battery_, *clock_;
  struct MissionFigure {
    FigureSpec spec;
    gui::Figure* view;
  };
  std::vector<MissionFigure> mission_;
  HoldButton* clear_;
  StopNote* stop_note_;
  StopButton* stop_;
};

}  // namespace kiln::gui
