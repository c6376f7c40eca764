#include "tests/gui/support/x_pointer.h"

#include <stdexcept>

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>

namespace kiln::gui {

struct XPointer::Impl {
  Display* display = XOpenDisplay(nullptr);
  ~Impl() {
    if (display) XCloseDisplay(display);
  }
  void button(bool down) const {
    XTestFakeButtonEvent(display, Button1, down ? 1 : 0, CurrentTime);
    XSync(display, 0);
  }
};

XPointer::XPointer() : impl_(std::make_unique<Impl>()) {
  int event = 0, error = 0, major = 0, minor = 0;
  if (!impl_->display || !XTestQueryExtension(impl_->display, &event, &error, &major, &minor))
    throw std::runtime_error("no X display with the extension XTEST");
}

XPointer::~XPointer() = default;

bool XPointer::managed() const {
  Display* const display = impl_->display;
  const Atom check = XInternAtom(display, "_NET_SUPPORTING_WM_CHECK", 0);
  Atom type = 0;
  int format = 0;
  unsigned long count = 0, left = 0;
  unsigned char* value = nullptr;
  XGetWindowProperty(display, DefaultRootWindow(display), check, 0, 1, 0, XA_WINDOW, &type, &format,
                     &count, &left, &value);
  if (value) XFree(value);
  return count == 1;
}

void XPointer::moveTo(int x_px, int y_px) {
  XTestFakeMotionEvent(impl_->display, -1, x_px, y_px, CurrentTime);
  XSync(impl_->display, 0);
}

void XPointer::press() { impl_->button(true); }
void XPointer::key(unsigned long keysym, bool down) {
  XTestFakeKeyEvent(impl_->display, XKeysymToKeycode(impl_->display, keysym), down ? 1 : 0,
                    CurrentTime);
  XSync(impl_->display, 0);
}
void XPointer::release() { impl_->button(false); }

}  // namespace kiln::gui
