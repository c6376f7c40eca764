#include "gui/app/stall_meter.h"

#include <algorithm>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr std::size_t kBins = 2000;
}

StallMeter::StallMeter(const Clock& clock, QObject* parent)
    : QObject(parent), clock_(clock), histogram_(kBins, 0) {
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &StallMeter::beat);
}

void StallMeter::start() {
  last_ = clock_.now();
  timer_.start(kBeat_ms);
}

void StallMeter::beat() {
  const Stamp now = clock_.now();
  const double gap_s = toSeconds(now - last_);
  last_ = now;
  ++beats_;
  worst_s_ = std::max(worst_s_, gap_s);
  if (gap_s > kLimit_s) ++above_;
  ++histogram_[std::min(kBins - 1, static_cast<std::size_t>(std::lround(gap_s * 1000)))];
}

QString StallMeter::report() const {
  std::uint64_t below = 0;
  std::size_t p99_ms = 0;
  while (p99_ms + 1 < kBins &&
         (below += static_cast<std::uint64_t>(histogram_[p99_ms])) * 100 < beats_ * 99)
    ++p99_ms;
  return QStringLiteral("event loop: %1 beats, worst gap %2 ms, p99 %3 ms, %4 above 100 ms")
      .arg(beats_)
      .arg(std::lround(worst_s_ * 1000))
      .arg(p99_ms)
      .arg(above_);
}

}  // namespace kiln::gui
