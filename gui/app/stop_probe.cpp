#include "gui/app/stop_probe.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QWidget>

namespace kiln::gui {
namespace {
constexpr int kPeriod_ms = 20;
constexpr double kRetry_s = 1.0;  // a lease request or a clear that got lost
}  // namespace

StopProbe::StopProbe(QWidget& window, StationModels& models, int presses, QObject* parent)
    : QObject(parent), window_(window), models_(models), presses_(presses) {
  connect(&models.link, &Link::stopLane, this, &StopProbe::onLane);
  connect(&timer_, &QTimer::timeout, this, &StopProbe::step);
  timer_.start(kPeriod_ms);
}

void StopProbe::enter(Step step) {
  step_ = step;
  entered_ = models_.clock().now();
}

void StopProbe::onLane(const StopLane& lane) {
  if (step_ != Step::AwaitLatch) return;
  if (!lane.acked) sent_ = true;
  if (!lane.acked || !sent_) return;  // an old answer is not this press's
  latch_s_.push_back(toSeconds(models_.clock().now() - pressed_));
  enter(Step::TakeLease);
  models_.lease.request();
}

void StopProbe::step() {
  const bool late = toSeconds(models_.clock().now() - entered_) > kRetry_s;
  switch (step_) {
    case Step::Connect:
      if (models_.status.hasData() && models_.stop.lane().reachable) enter(Step::Press);
      break;
    case Step::Press:
      sent_ = false;
      pressed_ = models_.clock().now();
      enter(Step::AwaitLatch);
      QCoreApplication::postEvent(&window_,
                                  new QKeyEvent(QEvent::KeyPress, Qt::Key_Pause, Qt::NoModifier));
      QCoreApplication::postEvent(&window_,
                                  new QKeyEvent(QEvent::KeyRelease, Qt::Key_Pause, Qt::NoModifier));
      break;
    case Step::AwaitLatch:
      break;  // onLane() goes on; the lane repeats by itself
    case Step::TakeLease:
      if (models_.lease.mine() && models_.stop.latched()) {
        models_.stop.clear();
        enter(Step::AwaitClear);
      } else if (late) {
        models_.lease.request();
        enter(Step::TakeLease);
      }
      break;
    case Step::Clear:
      models_.stop.clear();
      enter(Step::AwaitClear);
      break;
    case Step::AwaitClear:
      if (models_.stop.stage() == StopStage::Clear) {
        if (static_cast<int>(latch_s_.size()) >= presses_) {
          timer_.stop();
          emit finished();
        } else {
          enter(Step::Press);
        }
      } else if (late) {
        enter(Step::Clear);
      }
      break;
  }
}

}  // namespace kiln::gui
