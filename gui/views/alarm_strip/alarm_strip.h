#pragma once

#include <QWidget>

#include "gui/models/station_models.h"
#include "gui/widgets/act_button.h"

namespace kiln::gui {

/// One line at the bottom: the newest unacknowledged alarm of the highest level, what to do about
/// it, the first-out of a flood, and how many stand. Level by shape, text and colour. A quiet robot
/// leaves it grey.
class AlarmStrip : public QWidget {
  Q_OBJECT
 public:
  AlarmStrip(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] ActButton* acknowledgeButton() const { return acknowledge_; }
  [[nodiscard]] QString text() const;

 signals:
  void logRequested();
  void listRequested();  ///< a click beside the buttons

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  void refresh();
  [[nodiscard]] QString summary() const;
  Ui ui_;
  StationModels& models_;
  ActButton* acknowledge_;
  ActButton* log_;
};

}  // namespace kiln::gui
