#pragma once

#include <QString>

#include "common/model/fire.h"

class QPainter;
class QSize;

namespace kiln::gui {

class OrbitCamera;
struct SceneColors;
struct SceneSnapshot;

/// "place 1 · 0.86 m · ±2 cm" over "127 °C peak, 31 views"; the second line also names any
/// exaggeration of the drawn uncertainty. ± is two standard deviations along the worst axis.
struct FireLabel {
  QString title, detail;
};
[[nodiscard]] FireLabel fireLabel(const FireEstimate& fire);

/// Names of fires and places, and the age of what is stale, drawn over the picture.
void paintSceneLabels(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                      const SceneColors& colors, const QSize& size);

}  // namespace kiln::gui
