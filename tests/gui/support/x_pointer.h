#pragma once

#include <memory>

namespace kiln::gui {

/// Pointer and keyboard of the X display as a hand moves them: events come from the server, through the window
/// manager, as from a device (extension XTEST).
class XPointer {
 public:
  XPointer();  ///< throws std::runtime_error without a display or the extension
  ~XPointer();
  /// A window manager is at work on this display.
  [[nodiscard]] bool managed() const;
  void moveTo(int x_px, int y_px);  ///< of the screen
  void press();                     ///< left button
  void release();
  void key(unsigned long keysym, bool down);  ///< X11/keysymdef.h; a letter is its ASCII code

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::gui
