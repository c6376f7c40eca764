#include "gui/widgets/press_guard.h"

#include <QApplication>
#include <QMouseEvent>

namespace kiln::gui {

PressGuard::PressGuard(QWidget& control) : QObject(&control), control_(control) {
  qApp->installEventFilter(this);
}

PressGuard::~PressGuard() {
  if (qApp) qApp->removeEventFilter(this);
}

void PressGuard::begin(bool by_mouse) {
  window_ = control_.window();
  place_ = control_.mapTo(window_, QPoint());
  size_ = control_.size();
  by_mouse_ = by_mouse;
  had_focus_ = control_.hasFocus();
  watching_ = true;
}

void PressGuard::finish() {
  watching_ = false;
  emit over();
}

bool PressGuard::moved() const {
  return control_.window() != window_ || control_.size() != size_ ||
         control_.mapTo(window_, QPoint()) != place_;
}

bool PressGuard::ends(QObject* watched, const QEvent& event) const {
  if (watched == qApp)
    return event.type() == QEvent::ApplicationStateChange &&
           QApplication::applicationState() != Qt::ApplicationActive;
  auto* widget = qobject_cast<QWidget*>(watched);
  if (!widget || (widget != &control_ && !widget->isAncestorOf(&control_))) return false;
  switch (event.type()) {
    case QEvent::Hide:
    case QEvent::Close:
    case QEvent::WindowDeactivate:
    case QEvent::WindowBlocked:
    case QEvent::ParentChange:
      return true;
    case QEvent::EnabledChange:
      return !control_.isEnabled();
    case QEvent::FocusOut:
      return widget == &control_ && had_focus_;
    case QEvent::Move:
    case QEvent::Resize:
      return moved();
    default:
      return false;
  }
}

bool PressGuard::eventFilter(QObject* watched, QEvent* event) {
  if (!watching_) return false;
  switch (event->type()) {
    case QEvent::MouseButtonRelease:
    case QEvent::MouseMove:
    case QEvent::MouseButtonPress:
      if (by_mouse_ && watched->isWidgetType()) {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        const bool released =
            event->type() == QEvent::MouseButtonRelease && mouse->button() == Qt::LeftButton;
        if (released || !(mouse->buttons() & Qt::LeftButton)) finish();
      }
      break;
    default:
      if (ends(watched, *event)) finish();
      break;
  }
  return false;
}

}  // namespace kiln::gui
