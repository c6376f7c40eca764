#pragma once

class QPainter;
class QSize;

namespace kiln::gui {

class OrbitCamera;
class RobotShape;
struct SceneColors;
struct SceneSnapshot;

/// The scene from above with QPainter alone, for machines without OpenGL: the same snapshot, layers
/// and colours.
/// @param camera  in Mode::Top.
void paintTopView(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                  const SceneColors& colors, const RobotShape& shape, const QSize& size);

}  // namespace kiln::gui
