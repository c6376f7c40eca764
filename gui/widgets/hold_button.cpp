#include "gui/widgets/hold_button.h"

#include <QMouseEvent>
#include <algorithm>

namespace kiln::gui {

namespace {
constexpr int kTick_ms = 33;
}

HoldButton::HoldButton(const Ui& ui, const QString& title, double hold_s, QWidget* parent)
    : ActButton(ui, title, parent), guard_(*this), hold_s_(hold_s) {
  // By a key; the mouse is followed here, for QAbstractButton loses a release beside the button
  // and takes a pointer that comes back for a new press.
  connect(this, &QAbstractButton::pressed, this, [this] { begin(false); });
  connect(this, &QAbstractButton::released, this, &HoldButton::end);
  connect(&guard_, &PressGuard::over, this, &HoldButton::cancel);
  connect(&timer_, &QTimer::timeout, this, &HoldButton::tick);
}

HoldButton::~HoldButton() { end(); }

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

void HoldButton::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return event->ignore();
  event->accept();
  setDown(true);
  begin(true);
}

void HoldButton::mouseMoveEvent(QMouseEvent* event) {
  event->accept();
  if (since_ && !rect().contains(event->pos())) cancel();
}

void HoldButton::mouseReleaseEvent(QMouseEvent* event) {
  event->accept();
  if (event->button() == Qt::LeftButton) cancel();
}

void HoldButton::begin(bool by_mouse) {
  if (since_) return;
  since_ = ui().clock.now();
  done_ = false;
  guard_.begin(by_mouse);
  timer_.start(kTick_ms);
  update();
  emit engaged();
}

void HoldButton::end() {
  if (!since_) return;
  guard_.end();
  since_.reset();
  done_ = false;
  timer_.stop();
  update();
  emit disengaged();
}

}  // namespace kiln::gui
