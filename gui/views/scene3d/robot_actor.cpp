#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/scene_actor.h"
#include "gui/views/scene3d/vtk_shapes.h"

namespace kiln::gui {
namespace {

constexpr double kGhostOpacity = 0.35;

vtkSmartPointer<vtkPolyData> meshOf(const RobotPart& part) {
  switch (part.form) {
    case RobotPart::Form::Box:
      return boxMesh(part.size);
    case RobotPart::Form::Cylinder:
      return cylinderMesh(part.size.x(), part.size.z());
    case RobotPart::Form::Capsule:
      return capsuleMesh(part.size.x(), part.size.z());
  }
  return boxMesh(part.size);
}

Rgb colorOf(RobotPart::Role role, const SceneColors& c) {
  switch (role) {
    case RobotPart::Role::Body:
      return c.body;
    case RobotPart::Role::Tank:
      return mix(c.body, c.active, 0.35);
    case RobotPart::Role::Wheel:
      return c.wheel;
    case RobotPart::Role::Arm:
      return c.arm;
    case RobotPart::Role::Joint:
      return c.joint;
    case RobotPart::Role::Head:
      return c.head;
    case RobotPart::Role::Nozzle:
      return c.active;
  }
  return c.body;
}

/// Bob, moving with his joints and wheels. When the status is stale he becomes a pale ghost where
/// he was last heard.
class RobotActor final : public SceneActor {
 public:
  RobotActor(vtkRenderer& renderer, const RobotShape& shape) : shape_(shape) {
    for (const RobotPart& part : shape_.parts()) {
      actors_.push_back(addActor(renderer, meshOf(part)));
      const bool box = part.form == RobotPart::Form::Box;
      if (box) {
        actors_.back()->GetProperty()->SetInterpolationToFlat();
        actors_.back()->GetProperty()->EdgeVisibilityOn();
      }
    }
  }

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    const LayerState& layer = snapshot.layer(SceneLayer::Robot);
    const bool shown = layer.visible && snapshot.robot_known;
    const Eigen::Isometry3d X_map_base = snapshot.robotPose();
    const auto poses = shape_.poses(snapshot.q, snapshot.steer);
    for (std::size_t i = 0; i < actors_.size(); ++i) {
      actors_[i]->SetVisibility(shown);
      if (!shown) continue;
      setPose(*actors_[i], X_map_base * poses[i]);
      style(i, layer.freshness, colors);
    }
  }

 private:
  void style(std::size_t i, Freshness freshness, const SceneColors& colors) {
    vtkProperty& property = *actors_[i]->GetProperty();
    const bool ghost = freshness == Freshness::Stale;
    setColor(*actors_[i], agedColor(colorOf(shape_.parts()[i].role, colors), freshness, colors));
    const Rgb edge = agedColor(colors.body_edge, freshness, colors);
    property.SetEdgeColor(edge.r / 255.0, edge.g / 255.0, edge.b / 255.0);
    property.SetAmbient(ghost ? 0.85 : 0.25);
    property.SetDiffuse(ghost ? 0.15 : 0.75);
    property.SetOpacity(ghost ? kGhostOpacity : 1.0);
  }

  RobotShape shape_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
};

}  // namespace

std::unique_ptr<SceneActor> makeRobotActor(vtkRenderer& renderer, const RobotShape& shape) {
  return std::make_unique<RobotActor>(renderer, shape);
}

}  // namespace kiln::gui
