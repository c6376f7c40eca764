#pragma once

#include <QWidget>

#include "gui/models/station_models.h"
#include "gui/widgets/act_button.h"

namespace kiln::gui {

/// The robot's recorder: on or off, file, length, size and free disk, and the button for it. Moves
/// nothing, so it needs no lease.
class RecordChip : public QWidget {
  Q_OBJECT
 public:
  RecordChip(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] ActButton* button() const { return button_; }
  [[nodiscard]] QString text() const;
  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void refresh();
  void act();
  [[nodiscard]] bool troubled() const;
  Ui ui_;
  StationModels& models_;
  ActButton* button_;
};

/// "812 kB", "48.2 MB", "1.31 GB".
[[nodiscard]] QString bytesText(double bytes);

}  // namespace kiln::gui
