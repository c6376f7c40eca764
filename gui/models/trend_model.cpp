#include "gui/models/trend_model.h"

#include <cmath>

namespace kiln::gui {

TrendModel::TrendModel(Link& link, QObject* parent) : Model(link, AgeLimits{}, parent) {
  connect(&link, &Link::restarted, this, [this] {
    for (Series* series : {&rtt_, &peak_, &force_}) series->clear();
    touch();
  });
  connect(&link, &Link::health, this, [this](const LinkHealth& health) {
    const auto now = this->link().robotNow();
    if (!now) return;
    add(rtt_, *now,
        health.rtt_s >= 0 && (health.state == LinkState::Up || health.state == LinkState::Degraded)
            ? health.rtt_s
            : NAN);
    touch();
  });
  connect(&link, &Link::heat, this, [this](const std::shared_ptr<const HeatDetections>& heat) {
    add(peak_, heat->stamp, heat->usable ? heat->max_k : NAN);
    touch();
  });
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    add(force_, status->stamp, status->arm.wrench_tool.head<3>().norm());
    arrived(status->stamp);
  });
}

void TrendModel::add(Series& series, Stamp stamp, double value) {
  if (!series.empty() && stamp <= series.back().stamp) return;  // repeated or re-ordered
  series.push_back({stamp, value});
  while (toSeconds(stamp - series.front().stamp) > kWindow_s) series.pop_front();
}

}  // namespace kiln::gui
