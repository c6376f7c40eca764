#include "gui/app/stall_meter.h"

#include <algorithm>
#include <cmath>

#include <time.h>

namespace kiln::gui {

namespace {
constexpr std::size_t kBins = 2000;

double threadCpuS() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
}  // namespace

StallMeter::StallMeter(const Clock& clock, QObject* parent)
    : QObject(parent), clock_(clock), histogram_(kBins, 0) {
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &StallMeter::beat);
}

void StallMeter::start() {
  last_ = clock_.now();
  cpu_s_ = threadCpuS();
  timer_.start(kBeat_ms);
}

void StallMeter::beat() {
  const Stamp now = clock_.now();
  const double gap_s = toSeconds(now - last_);
  last_ = now;
  const double cpu_s = threadCpuS();
  const double busy_s = cpu_s - cpu_s_;
  cpu_s_ = cpu_s;
  worst_busy_s_ = std::max(worst_busy_s_, busy_s);
  if (busy_s > kLimit_s) ++busy_above_;
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
  return QStringLiteral(
             "event loop: %1 beats, worst gap %2 ms, p99 %3 ms, %4 above 100 ms; "
             "busy itself at most %5 ms, %6 above 100 ms")
      .arg(beats_)
      .arg(std::lround(worst_s_ * 1000))
      .arg(p99_ms)
      .arg(above_)
      .arg(std::lround(worst_busy_s_ * 1000))
      .arg(busy_above_);
}

}  // namespace kiln::gui
