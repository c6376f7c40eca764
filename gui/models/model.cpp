#include "gui/models/model.h"

#include <algorithm>
#include <utility>

namespace kiln::gui {

namespace {
constexpr double kPeriodSmoothing = 0.2;
}

Model::Model(Link& link, AgeLimits limits, QObject* parent)
    : QObject(parent), link_(link), limits_(limits) {
  // In a recording that jumps, the gap says nothing of age or rate; the value of the new time is on
  // its way.
  connect(&link_, &Link::restarted, this, [this] {
    period_s_ = 0.0;
    if (!received_) return;
    received_ = stationNow();
    stamp_ = link_.robotNow().value_or(stamp_);
    jumped_ = true;
  });
}

double Model::ageS() const {
  if (!received_) return -1.0;
  const double since_arrival = toSeconds(stationNow() - *received_);
  const auto robot_now = link_.robotNow();
  const double in_robot_time = robot_now ? toSeconds(*robot_now - stamp_) : 0.0;
  return std::max({since_arrival, in_robot_time, 0.0});
}

double Model::rateHz() const {
  if (!received_ || period_s_ <= 0) return 0.0;
  // A topic that has fallen silent slows down on the badge as well.
  return 1.0 / std::max(period_s_, toSeconds(stationNow() - *received_));
}

void Model::arrived(Stamp stamp) {
  const Stamp now = stationNow();
  if (received_ && !std::exchange(jumped_, false)) {
    const double gap_s = toSeconds(now - *received_);
    period_s_ = period_s_ <= 0 ? gap_s : period_s_ + kPeriodSmoothing * (gap_s - period_s_);
  }
  received_ = now;
  stamp_ = stamp;
  dirty_ = true;
}

void Model::forget() {
  received_.reset();
  stamp_ = {};
  period_s_ = 0.0;
  jumped_ = false;
  dirty_ = true;
}

void Model::flush() {
  if (!dirty_) return;
  dirty_ = false;
  emit changed();
}

}  // namespace kiln::gui
