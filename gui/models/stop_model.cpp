#include "gui/models/stop_model.h"

namespace kiln::gui {

StopModel::StopModel(Link& link, CommandModel& commands, QObject* parent)
    : Model(link, AgeLimits{}, parent), commands_(commands) {
  connect(&link, &Link::stopLane, this, [this](const StopLane& lane) {
    lane_ = lane;
    touch();
  });
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    robot_ = status->stop;
    arrived(status->stamp);
  });
}

StopStage StopModel::stage() const {
  const bool known = hasData() && ageLevel() != AgeLevel::Red;
  if (known && robot_.latched)
    return robot_.standstill_proven ? StopStage::Standstill : StopStage::Latched;
  if (lane_.pressed) {
    return lane_.acked ? StopStage::Latched : lane_.reachable ? StopStage::Sent : StopStage::Kept;
  }
  return lane_.reachable ? StopStage::Clear : StopStage::Unreachable;
}

void StopModel::press() {
  link().stop();
  touch();
}

void StopModel::clear() { commands_.send(ClearStop{robot_.generation}, tr("clear the stop")); }

}  // namespace kiln::gui
