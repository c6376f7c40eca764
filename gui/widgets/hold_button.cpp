#include "gui/widgets/hold_button.h"

#include <QApplication>
#include <QMouseEvent>
#include <algorithm>

namespace kiln::gui {

namespace {
constexpr int kTick_ms = 33;
}

HoldButton::HoldButton(const Ui& ui, const QString& title, double hold_s, QWidget* parent)
    : ActButton(ui, title, parent), hold_s_(hold_s) {
  connect(this, &QAbstractButton::pressed, this, &HoldButton::begin);
  connect(this, &QAbstractButton::released, this, &HoldButton::end);
  connect(&timer_, &QTimer::timeout, this, &HoldButton::tick);
  qApp->installEventFilter(this);
}

HoldButton::~HoldButton() {
  if (qApp) qApp->removeEventFilter(this);
}

double HoldButton::progress() const {
  if (!since_) return 0.0;
  if (done_ || hold_s_ <= 0) return 1.0;
  return std::clamp(toSeconds(ui().clock.now() - *since_) / hold_s_, 0.0, 1.0);
}

void HoldButton::tick() {
  if (!since_) return;
  update();
  if (hold_s_ <= 0 || done_ || progress() < 1.0) return;
  done_ = true;
  emit completed();
}

void HoldButton::cancel() {
  if (isDown()) setDown(false);
  end();
}

QSize HoldButton::sizeHint() const { return ActButton::sizeHint() + QSize(8, 0); }

bool HoldButton::event(QEvent* event) {
  switch (event->type()) {
    case QEvent::FocusOut:
    case QEvent::Hide:
    case QEvent::WindowDeactivate:
      cancel();
      break;
    case QEvent::EnabledChange:
      if (!isEnabled()) cancel();
      break;
    default:
      break;
  }
  return ActButton::event(event);
}

bool HoldButton::eventFilter(QObject* watched, QEvent* event) {
  // The desktop may take the keyboard away without this widget losing its focus (screen lock,
  // another program).
  if (watched == qApp && event->type() == QEvent::ApplicationStateChange &&
      QApplication::applicationState() != Qt::ApplicationActive) {
    cancel();
  }
  return ActButton::eventFilter(watched, event);
}

void HoldButton::mouseMoveEvent(QMouseEvent* event) {
  ActButton::mouseMoveEvent(event);
  if (since_ && !rect().contains(event->pos())) cancel();
}

void HoldButton::begin() {
  if (since_) return;
  since_ = ui().clock.now();
  done_ = false;
  timer_.start(kTick_ms);
  update();
  emit engaged();
}

void HoldButton::end() {
  if (!since_) return;
  since_.reset();
  done_ = false;
  timer_.stop();
  update();
  emit disengaged();
}

}  // namespace kiln::gui
