#pragma once

#include "gui/models/model.h"

namespace kiln::gui {

/// What the robot's mission brings: figures, layers, commands, panels. Changes only when the robot
/// tells of another mission.
class MissionModel : public Model {
  Q_OBJECT
 public:
  explicit MissionModel(Link& link, QObject* parent = nullptr);
  /// Empty before the robot has told.
  [[nodiscard]] const MissionInfo& info() const { return info_; }

 private:
  MissionInfo info_;
};

}  // namespace kiln::gui
