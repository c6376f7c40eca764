#include "gui/panels/fire/aim_marks.h"

#include <cmath>

#include "common/wire/fire/codec/fire_codec.h"
#include "gui/models/localization_model.h"

namespace kiln::gui {

namespace {
constexpr double kPlateRadius_m = 0.075;
}

QString aimText(const fire::JetAim& aim) {
  if (aim.place.empty()) return QObject::tr("the jet ends here");
  const QString place = QString::fromStdString(aim.place);
  if (std::hypot(aim.left_m, aim.up_m) <= kPlateRadius_m)
    return QObject::tr("%1: on the plate").arg(place);
  return QObject::tr("%1: %2 %3, %4 %5")
      .arg(place, lengthText(std::abs(aim.left_m)),
           aim.left_m < 0.0 ? QObject::tr("right") : QObject::tr("left"),
           lengthText(std::abs(aim.up_m)),
           aim.up_m < 0.0 ? QObject::tr("low") : QObject::tr("high"));
}

AimMarks::AimMarks(StationModels& models, QObject* parent) : PictureMarks(parent), models_(models) {
  connect(&models_.scene, &Model::changed, this, [this] {
    const auto& scene = models_.scene.scene();
    if (!scene || scene->detail.schema != fire::kSiteSchema) return;
    const auto site = wire::decodeFireSite(scene->detail.data);
    aim_ = site ? fire::jetAim(*site) : std::nullopt;
    emit changed();
  });
}

std::vector<PictureMark> AimMarks::marks() const {
  if (!aim_ || models_.status.ageLevel() != AgeLevel::Fresh) return {};
  return {{aim_->p_map, aimText(*aim_)}};
}

}  // namespace kiln::gui
