#include "gui/models/mission_model.h"

namespace kiln::gui {

MissionModel::MissionModel(Link& link, QObject* parent) : Model(link, kSlowAge, parent) {
  connect(&link, &Link::missionInfo, this, [this](const std::shared_ptr<const MissionInfo>& info) {
    if (*info == info_) return;
    info_ = *info;
    touch();
  });
}

}  // namespace kiln::gui
