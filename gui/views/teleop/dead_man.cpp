#include "gui/views/teleop/dead_man.h"

#include <QApplication>
#include <QEvent>
#include <QWidget>

#include "gui/views/teleop/hold_to_run.h"

namespace kiln::gui {

DeadMan::DeadMan(HoldToRun& hold, QWidget& panel) : QObject(&panel), hold_(hold), panel_(&panel) {
  connect(&panel, &QObject::destroyed, &hold, [&hold] {
    if (hold.holding()) hold.releaseAll(tr("the controls are gone"));
  });
  qApp->installEventFilter(this);  // sees every window, also one that the panel moves to later
  connect(qApp, &QApplication::focusChanged, this, &DeadMan::focusMoved);
  connect(qApp, &QGuiApplication::applicationStateChanged, this,
          [this](Qt::ApplicationState state) {
            if (state != Qt::ApplicationActive) trip(tr("another program has the screen"));
          });
}

void DeadMan::trip(const QString& why) {
  if (hold_.holding()) hold_.releaseAll(why);
}

bool DeadMan::eventFilter(QObject* watched, QEvent* event) {
  if (panel_ && (watched == panel_ || watched == panel_->window())) {
    switch (event->type()) {
      case QEvent::WindowDeactivate:
        trip(tr("the window lost the keyboard"));
        break;
      case QEvent::WindowBlocked:
        trip(tr("a dialog is open"));
        break;
      case QEvent::Hide:
      case QEvent::Close:
        trip(tr("the controls are hidden"));
        break;
      case QEvent::EnabledChange:
        if (!panel_->isEnabled()) trip(tr("the controls are locked"));
        break;
      default:
        break;
    }
  }
  return QObject::eventFilter(watched, event);
}

void DeadMan::focusMoved(QWidget* from, QWidget* to) {
  const bool was_here = from && panel_ && (from == panel_ || panel_->isAncestorOf(from));
  const bool is_here = to && panel_ && (to == panel_ || panel_->isAncestorOf(to));
  if (was_here && !is_here) trip(tr("the keyboard went elsewhere"));
}

}  // namespace kiln::gui
