#include "gui/views/scene3d/scene_renderer.h"

#include <cstring>

#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkLightsPass.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>

#include "common/core/units.h"
#include "gui/views/scene3d/scene_actor.h"

namespace kiln::gui {

Rgb agedColor(Rgb color, Freshness freshness, const SceneColors& colors) {
  switch (freshness) {
    case Freshness::Missing:
    case Freshness::Fresh:
      return color;
    case Freshness::Aging:
      return mix(desaturate(color, 0.7), colors.ground, 0.2);
    case Freshness::Stale:
      return mix(desaturate(color, 1.0), colors.ground, 0.4);
  }
  return color;
}

namespace {
/// Opaque, then translucent over it, straight into the window's buffer. VTK's own choice averages
/// the translucent colours in buffers of floats, which costs a software renderer half of its time;
/// our few pale solids look the same without.
void usePlainPasses(vtkRenderer& renderer) {
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(vtkNew<vtkOpaquePass>());
  passes->AddItem(vtkNew<vtkTranslucentPass>());
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  renderer.SetPass(camera);
}
}  // namespace

struct SceneRenderer::Impl {
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkUnsignedCharArray> pixels;
  std::vector<std::unique_ptr<SceneActor>> actors;

  void aim(const OrbitCamera& camera) {
    vtkCamera& out = *renderer->GetActiveCamera();
    const Eigen::Vector3d p = camera.position(), up = camera.up();
    out.SetPosition(p.data());
    out.SetFocalPoint(camera.target().data());
    out.SetViewUp(up.data());
    out.SetViewAngle(camera.fieldOfView() / kDeg);
    out.SetParallelProjection(camera.parallel());
    out.SetParallelScale(camera.halfHeight());
    renderer->ResetCameraClippingRange();
  }
};

SceneRenderer::SceneRenderer(Config config, const RobotShape& shape)
    : impl_(std::make_unique<Impl>()) {
  impl_->window->SetOffScreenRendering(1);
  impl_->window->SetMultiSamples(config.samples);
  impl_->window->AddRenderer(impl_->renderer);
  vtkRenderer& renderer = *impl_->renderer;
  usePlainPasses(renderer);
  impl_->actors.push_back(makeGridActor(renderer));
  impl_->actors.push_back(makeMapActor(renderer));
  impl_->actors.push_back(makeArenaActor(renderer));
  impl_->actors.push_back(makeRobotActor(renderer, shape));
  impl_->actors.push_back(makeCloudActor(renderer, config.point_budget));
  impl_->actors.push_back(makePlannedPathActor(renderer));
  impl_->actors.push_back(makeDrivenPathActor(renderer));
  impl_->actors.push_back(makeEstimateActor(renderer));
}

SceneRenderer::~SceneRenderer() {
  impl_->actors.clear();  // before the renderer that they are in
}

QImage SceneRenderer::render(const SceneSnapshot& snapshot, const OrbitCamera& camera,
                             const SceneColors& colors, int width, int height) {
  if (width <= 0 || height <= 0) return {};
  for (const auto& actor : impl_->actors) actor->update(snapshot, colors);
  const Rgb g = colors.ground;
  impl_->renderer->SetBackground(g.r / 255.0, g.g / 255.0, g.b / 255.0);
  impl_->aim(camera);
  const int* size = impl_->window->GetSize();
  if (size[0] != width || size[1] != height) impl_->window->SetSize(width, height);
  impl_->window->Render();
  impl_->window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, impl_->pixels);
  QImage image(width, height, QImage::Format_RGBX8888);
  const unsigned char* rows = impl_->pixels->GetPointer(0);
  const auto row_bytes = static_cast<std::size_t>(4 * width);
  for (int y = 0; y < height; ++y)  // OpenGL counts rows from the bottom
    std::memcpy(image.scanLine(y), rows + static_cast<std::size_t>(height - 1 - y) * row_bytes,
                row_bytes);
  return image;
}

}  // namespace kiln::gui
