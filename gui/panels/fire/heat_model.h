#pragma once

#include "common/wire/fire/fire_model.h"
#include "gui/models/model.h"

namespace kiln::gui {

/// What the robot's detector found in the newest thermal image.
class HeatModel : public Model {
  Q_OBJECT
 public:
  explicit HeatModel(Link& link, QObject* parent = nullptr);
  /// Of the newest image or of one shortly before it; may be null.
  [[nodiscard]] const std::shared_ptr<const HeatDetections>& heat() const { return heat_; }

 private:
  std::shared_ptr<const HeatDetections> heat_;
};

}  // namespace kiln::gui
