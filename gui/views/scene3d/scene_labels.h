#pragma once

#include <QString>

#include "common/model/scene.h"

class QPainter;
class QSize;

namespace kiln::gui {

class OrbitCamera;
struct SceneColors;
struct SceneSnapshot;

/// Label over detail; the second line also names any exaggeration of the drawn uncertainty.
struct ItemCard {
  QString title, detail;
};
[[nodiscard]] ItemCard itemCard(const SceneItem& item);

/// What the mission's items are called, and the age of what is stale, drawn over the picture.
void paintSceneLabels(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                      const SceneColors& colors, const QSize& size);

}  // namespace kiln::gui
