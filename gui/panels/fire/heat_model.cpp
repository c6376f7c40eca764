#include "gui/panels/fire/heat_model.h"

#include <algorithm>

#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"

namespace kiln::gui {

HeatModel::HeatModel(Link& link, QObject* parent) : Model(link, kVideoAge, parent) {
  connect(&link, &Link::absent, this, [this](const std::vector<Topic>& topics) {
    if (std::find(topics.begin(), topics.end(), Topic::MissionStream) == topics.end()) return;
    heat_.reset();
    forget();
  });
  connect(&link, &Link::missionStream, this,
          [this](const std::shared_ptr<const MissionDetail>& detail) {
            if (detail->schema != fire::kHeatSchema) return;
            auto heat = wire::decodeHeat(detail->data);
            if (!heat) return;
            heat_ = std::make_shared<const HeatDetections>(std::move(*heat));
            arrived(heat_->stamp);
          });
}

}  // namespace kiln::gui
