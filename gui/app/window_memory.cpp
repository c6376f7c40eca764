#include "gui/app/window_memory.h"

#include <QApplication>
#include <QFileInfo>
#include <QScreen>

namespace kiln::gui {

namespace {
constexpr QSize kDefault{1680, 1020};
constexpr QSize kFrame{4, 40};  ///< what a window manager adds, until it has told
const auto kGeometry = QStringLiteral("window/geometry");
const auto kTheme = QStringLiteral("window/theme");
const auto kChoices = QStringLiteral("window/choices");
constexpr qint64 kMost_bytes = 1 << 20;

/// @return `file`, or nothing: a pipe would be waited for, a huge file read whole.
QString usable(const QString& file) {
  const QFileInfo info(file);
  return !info.exists() || (info.isFile() && info.size() <= kMost_bytes) ? file : QString();
}
}  // namespace

WindowMemory::WindowMemory(const QString& file)
    : settings_(usable(file.isEmpty() ? QSettings(QSettings::IniFormat, QSettings::UserScope,
                                                  QStringLiteral("kiln"), QStringLiteral("station"))
                                            .fileName()
                                      : file),
                QSettings::IniFormat) {}

ThemeKind WindowMemory::theme() const {
  return settings_.value(kTheme).toString() == QLatin1String("light") ? ThemeKind::Light
                                                                      : ThemeKind::Dark;
}

void WindowMemory::place(QWidget& window, const QSize& wanted) const {
  const bool as_left =
      wanted.isEmpty() && window.restoreGeometry(settings_.value(kGeometry).toByteArray());
  if (as_left && window.windowState() != Qt::WindowNoState) return;
  const QScreen* screen = window.screen() ? window.screen() : QGuiApplication::primaryScreen();
  const QSize size = as_left ? window.size() : wanted.isEmpty() ? kDefault : wanted;
  const QSize room = screen ? screen->availableGeometry().size() - kFrame : size;
  window.resize(size.boundedTo(room));
  if (size.width() > room.width() || size.height() > room.height())
    window.setWindowState(window.windowState() | Qt::WindowMaximized);
}

QString WindowMemory::choices() const { return settings_.value(kChoices).toString(); }

void WindowMemory::keep(const QWidget& window, ThemeKind theme, const QString& choices) {
  settings_.setValue(kChoices, choices);
  settings_.setValue(kGeometry, window.saveGeometry());
  settings_.setValue(kTheme,
                     theme == ThemeKind::Light ? QStringLiteral("light") : QStringLiteral("dark"));
}

}  // namespace kiln::gui
