#include "gui/app/window_memory.h"

#include <QApplication>
#include <QScreen>

namespace kiln::gui {

namespace {
constexpr QSize kDefault{1680, 1020};
constexpr QSize kFrame{4, 40};  ///< what a window manager adds, until it has told
const auto kGeometry = QStringLiteral("window/geometry");
const auto kTheme = QStringLiteral("window/theme");
}  // namespace

WindowMemory::WindowMemory(const QString& file)
    : settings_(file.isEmpty() ? QSettings(QSettings::IniFormat, QSettings::UserScope,
                                           QStringLiteral("kiln"), QStringLiteral("station"))
                                     .fileName()
                               : file,
                QSettings::IniFormat) {}

ThemeKind WindowMemory::theme() const {
  return settings_.value(kTheme).toString() == QLatin1String("light") ? ThemeKind::Light
                                                                      : ThemeKind::Dark;
}

void WindowMemory::place(QWidget& window, const QSize& wanted) const {
  if (wanted.isEmpty() && window.restoreGeometry(settings_.value(kGeometry).toByteArray())) return;
  const QScreen* screen = QGuiApplication::primaryScreen();
  const QSize size = wanted.isEmpty() ? kDefault : wanted;
  const QSize room = screen ? screen->availableGeometry().size() - kFrame : size;
  window.resize(size.boundedTo(room));
  if (size.width() > room.width() || size.height() > room.height())
    window.setWindowState(window.windowState() | Qt::WindowMaximized);
}

void WindowMemory::keep(const QWidget& window, ThemeKind theme) {
  settings_.setValue(kGeometry, window.saveGeometry());
  settings_.setValue(kTheme,
                     theme == ThemeKind::Light ? QStringLiteral("light") : QStringLiteral("dark"));
}

}  // namespace kiln::gui
