#pragma once

#include <QString>

#include "common/model/scene.h"

class QPainter;
class QPointF;
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
/// The labelled item at a point of the picture, the nearest within a finger's breadth; nullptr:
/// none. Points into the snapshot.
[[nodiscard]] const SceneItem* itemAt(const SceneSnapshot& snapshot, const OrbitCamera& camera,
                                      const QSize& size, const QPointF& at);

/// What the mission's items are called, and the age of what is stale, drawn over the picture.
void paintSceneLabels(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                      const SceneColors& colors, const QSize& size);

}  // namespace kiln::gui
