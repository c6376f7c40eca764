#include "gui/app/stop_probe.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QWidget>

namespace kiln::gui {
namespace {
constexpr int kPeriod_ms = 20;
constexpr double kAskAgain_s = 1.0;  // a lease request or a clear that got lost
constexpr double kStepLimit_s = 10.0;
}  // namespace

StopProbe::StopProbe(QWidget& window, StationModels& models, int presses, QObject* parent)
    : QObject(parent), window_(window), models_(models), presses_(presses) {
  entered_ = models_.clock().now();
  connect(&models.link, &Link::stopLane, this, &StopProbe::onLane);
  connect(&timer_, &QTimer::timeout, this, &StopProbe::step);
  timer_.start(kPeriod_ms);
}

void StopProbe::enter(Step step) {
  step_ = step;
  entered_ = models_.clock().now();
  if (step_ == Step::Press) press();
  if (step_ == Step::TakeLease || step_ == Step::Clear) ask();
}

void StopProbe::press() {
  press_ = models_.stop.lane().press + 1;
  pressed_ = entered_;
  step_ = Step::AwaitLatch;
  for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease}) {
    QCoreApplication::postEvent(&window_, new QKeyEvent(type, Qt::Key_Pause, Qt::NoModifier));
  }
}

void StopProbe::ask() {
  asked_ = models_.clock().now();
  if (step_ == Step::TakeLease) models_.lease.request();
  if (step_ == Step::Clear) models_.stop.clear();
}

void StopProbe::onLane(const StopLane& lane) {
  // Told by the number of the press: the lane reports its newest state only, so an answer that
  // comes before this window has looked hides that the request was ever under way.
  if (step_ != Step::AwaitLatch || !lane.acked || lane.press != press_) return;
  latch_s_.push_back(toSeconds(models_.clock().now() - pressed_));
  enter(Step::AwaitStatus);
}

bool StopProbe::reached() const {
  switch (step_) {
    case Step::Connect:
      return models_.status.hasData() && models_.stop.lane().reachable &&
             models_.link.robotNow().has_value();
    case Step::Press:
    case Step::AwaitLatch:
      return false;  // onLane() goes on; the lane repeats by itself
    case Step::AwaitStatus:
      return models_.stop.robot().latched;
    case Step::TakeLease:
      return models_.lease.mine();
    case Step::Clear:
      return !models_.stop.robot().latched;
  }
  return false;
}

StopProbe::Step StopProbe::next() const {
  switch (step_) {
    case Step::AwaitStatus:
      return Step::TakeLease;
    case Step::TakeLease:
      return Step::Clear;
    default:
      return Step::Press;
  }
}

QString StopProbe::waitingFor() const {
  switch (step_) {
    case Step::Connect:
      return tr("the robot's status, stop lane and clock");
    case Step::Press:
    case Step::AwaitLatch:
      return tr("the answer to the STOP");
    case Step::AwaitStatus:
      return tr("a status that says STOPPED");
    case Step::TakeLease:
      return tr("the lease (%1)").arg(models_.lease.refusal());
    case Step::Clear:
      return tr("a status that says the stop is cleared");
  }
  return {};
}

void StopProbe::step() {
  const Stamp now = models_.clock().now();
  if (reached()) {
    if (step_ == Step::Clear && static_cast<int>(latch_s_.size()) >= presses_) {
      timer_.stop();
      emit finished();
    } else {
      enter(next());
    }
  } else if (toSeconds(now - entered_) > kStepLimit_s) {
    timer_.stop();
    emit failed(tr("waited %1 s in vain for %2, after %3 of %4 presses")
                    .arg(kStepLimit_s)
                    .arg(waitingFor())
                    .arg(latch_s_.size())
                    .arg(presses_));
  } else if (toSeconds(now - asked_) > kAskAgain_s) {
    ask();
  }
}

}  // namespace kiln::gui
