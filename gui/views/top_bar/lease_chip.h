#pragma once

#include <QWidget>

#include "gui/models/lease_model.h"
#include "gui/widgets/act_button.h"

namespace kiln::gui {

/// Who is in control, and the button to ask for it or to give it back.
class LeaseChip : public QWidget {
  Q_OBJECT
 public:
  LeaseChip(const Ui& ui, LeaseModel& lease, QWidget* parent = nullptr);
  [[nodiscard]] QString text() const;
  /// For a chip that is too narrow for text().
  [[nodiscard]] QString shortText() const;
  [[nodiscard]] ActButton* button() const { return button_; }
  /// Also needed while nothing arrives: an old lease is no lease.
  void refresh();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void act();
  Ui ui_;
  LeaseModel& lease_;
  ActButton* button_;
};

}  // namespace kiln::gui
