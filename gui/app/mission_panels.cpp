#include "gui/app/mission_panels.h"

#include <QHBoxLayout>
#include <algorithm>

#include "gui/views/camera/camera_tile.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/scene3d/scene_tile.h"

namespace kiln::gui {
namespace {
constexpr int kWarnLevel = 3;
constexpr int kImageStretch = 6;
}  // namespace

MissionPanels::MissionPanels(const PanelParts& parts, const Places& places,
                             const std::vector<PanelKind>& catalog, QObject* parent)
    : QObject(parent),
      ui_(parts.ui),
      models_(parts.models),
      hold_(parts.hold),
      geometry_(parts.geometry),
      places_(places),
      catalog_(catalog) {
  connect(&models_.mission, &Model::changed, this, &MissionPanels::refresh);
  refresh();
}

void MissionPanels::refresh() {
  const auto& wanted = models_.mission.info().panels;
  if (wanted == shown_) return;
  clear();
  shown_ = wanted;
  for (auto row = wanted.begin(); row != wanted.end(); ++row) {
    const std::string& id = *row;
    if (std::find(wanted.begin(), row, id) != row) continue;  // named twice
    const auto kind = std::find_if(catalog_.begin(), catalog_.end(),
                                   [&](const PanelKind& known) { return known.id == id; });
    if (kind != catalog_.end()) {
      add(*kind);
    } else {
      models_.log.addOwn(kWarnLevel, tr("this station has no panel \"%1\" for the mission; is it "
                                        "older than the robot?")
                                         .arg(QString::fromStdString(id)));
    }
  }
}

void MissionPanels::clear() {
  for (const auto& image : images_) delete image;
  images_.clear();
  places_.scene->removeCards();
  places_.macros->setHands(nullptr);
  places_.camera->setMarks(nullptr);
}

void MissionPanels::add(const PanelKind& kind) {
  const PanelParts parts{ui_, models_, hold_, geometry_};
  if (kind.image) {
    QWidget* image = kind.image(parts);
    places_.images->insertWidget(static_cast<int>(images_.size()), image, kImageStretch);
    images_.emplace_back(image);
  }
  if (kind.scene) places_.scene->addCard(kind.scene(parts, &places_.scene->canvas()));
  if (kind.marks) places_.camera->setMarks(kind.marks(parts), geometry_);
  if (kind.hands) places_.macros->setHands(kind.hands(parts));
}

}  // namespace kiln::gui
