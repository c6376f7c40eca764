#pragma once

#include <QApplication>

namespace kiln::gui {

/// The one QApplication of a test program, without a display unless the test is run under one.
inline QApplication& testApp() {
  static const bool chosen = [] {
    if (qEnvironmentVariableIsEmpty("DISPLAY") && qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
      qputenv("QT_QPA_PLATFORM", "offscreen");
    return true;
  }();
  static int argc = 1;
  static char name[] = "views_test";
  static char* argv[] = {name, nullptr};
  static QApplication app(argc, argv);
  Q_UNUSED(chosen);
  return app;
}

}  // namespace kiln::gui
