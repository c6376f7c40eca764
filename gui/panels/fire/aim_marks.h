#pragma once

#include "common/wire/fire/fire_model.h"
#include "common/wire/fire/fire_view.h"
#include "gui/models/station_models.h"
#include "gui/views/camera/picture_marks.h"

namespace kiln::gui {

/// "place 1: on the plate", "place 1: 12 cm left, 5.0 cm low"; "the jet ends here" where it hits no
/// plate.
[[nodiscard]] QString aimText(const fire::JetAim& aim);

/// Marks where the jet would hit, as the robot last told it (once a second).
class AimMarks : public PictureMarks {
  Q_OBJECT
 public:
  explicit AimMarks(StationModels& models, QObject* parent = nullptr);
  [[nodiscard]] std::vector<PictureMark> marks() const override;

 private:
  StationModels& models_;
  std::optional<fire::JetAim> aim_;
};

}  // namespace kiln::gui
