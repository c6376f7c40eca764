#include <QOffscreenSurface>
#include <QOpenGLContext>

#include "gui/views/scene3d/scene_renderer.h"

namespace kiln::gui {

bool openGlAvailable() {
  if (qEnvironmentVariableIsEmpty("DISPLAY")) return false;  // VTK's window is an X11 one
  QOpenGLContext context;
  if (!context.create()) return false;
  QOffscreenSurface surface;
  surface.setFormat(context.format());
  surface.create();
  if (!surface.isValid() || !context.makeCurrent(&surface)) return false;
  context.doneCurrent();
  return true;
}

}  // namespace kiln::gui
