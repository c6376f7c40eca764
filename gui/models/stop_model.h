#pragma once

#include "gui/models/command_model.h"
#include "gui/models/model.h"

namespace kiln::gui {

enum class StopStage : std::uint8_t {
  Unreachable,  ///< the robot is not heard: a press is kept until it is
  Kept,         ///< pressed while it is not heard: goes out by itself as soon as it is
  Clear,        ///< nothing latched
  Sent,         ///< asked, not yet latched
  Latched,      ///< the robot has latched it; something may still coast
  Standstill,   ///< latched, and wheels, joints and pumps were measured at rest
};

/// STOP (software): the lane's own answer joined with what the robot's status says.
class StopModel : public Model {
  Q_OBJECT
 public:
  StopModel(Link& link, CommandModel& commands, QObject* parent = nullptr);
  [[nodiscard]] StopStage stage() const;
  [[nodiscard]] bool latched() const {
    return stage() == StopStage::Latched || stage() == StopStage::Standstill;
  }
  [[nodiscard]] const StopLane& lane() const { return lane_; }
  [[nodiscard]] const StopStatus& robot() const { return robot_; }
  /// Of a recording: there is nothing to stop.
  [[nodiscard]] bool recorded() const { return link().readOnly(); }
  void press();
  /// Needs the lease; the caller has made the operator hold for 1 s. Moves nothing.
  void clear();

 private:
  CommandModel& commands_;
  StopLane lane_;
  StopStatus robot_;
};

}  // namespace kiln::gui
