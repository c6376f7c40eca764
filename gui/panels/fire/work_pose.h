#pragma once

#include <QWidget>
#include <optional>

#include "common/wire/fire/fire_model.h"
#include "gui/models/station_models.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// From the base to where it is to stand.
struct WorkOffset {
  QString place;
  Pose2 X_base_work;
  /// Near enough for the macros of the place (resources/macros/fire).
  [[nodiscard]] bool reached() const;
};

/// To the nearest place that was not visited yet, of those that were if none is left; nullopt:
/// none is told.
[[nodiscard]] std::optional<WorkOffset> nearestWorkPose(const FireSite& site,
                                                        const Pose2& X_map_base);
/// "place 1: 0.42 m ahead, 0.10 m right, turn 12° left".
[[nodiscard]] QString workText(const WorkOffset& offset);

/// One line: the way to the nearest work pose, as of now.
class WorkPoseLine : public QWidget {
  Q_OBJECT
 public:
  WorkPoseLine(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] QString text() const;
  [[nodiscard]] QSize sizeHint() const override { return {240, 16}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] std::optional<WorkOffset> offset() const;
  Ui ui_;
  StationModels& models_;
  FireSite site_;
};

}  // namespace kiln::gui
