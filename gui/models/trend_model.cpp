#include "gui/models/trend_model.h"

#include <cmath>

namespace kiln::gui {

TrendModel::TrendModel(Link& link, QObject* parent) : Model(link, AgeLimits{}, parent) {
  connect(&link, &Link::restarted, this, [this] {
    for (Series* series : {&rtt_, &force_}) series->clear();
    for (auto& [id, series] : figures_) series.clear();
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
  connect(&link, &Link::missionInfo, this, [this](const std::shared_ptr<const MissionInfo>& info) {
    std::map<std::string, Series> plotted;
    for (const FigureSpec& spec : info->figures)
      if (spec.plot) plotted[spec.id] = std::move(figures_[spec.id]);
    figures_ = std::move(plotted);
  });
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    add(force_, status->stamp, status->arm.wrench_tool.head<3>().norm());
    addFigures(*status);
    arrived(status->stamp);
  });
}

void TrendModel::addFigures(const RobotStatus& status) {
  for (auto& [id, series] : figures_) {
    const Figure* figure = findFigure(status.figures, id);
    add(series, status.stamp, figure ? figure->value : NAN);
  }
}

const TrendModel::Series& TrendModel::figure(const std::string& id) const {
  static const Series kNone;
  const auto found = figures_.find(id);
  return found == figures_.end() ? kNone : found->second;
}

void TrendModel::add(Series& series, Stamp stamp, double value) {
  if (!series.empty() && stamp <= series.back().stamp) return;  // repeated or re-ordered
  series.push_back({stamp, value});
  while (toSeconds(stamp - series.front().stamp) > kWindow_s) series.pop_front();
}

}  // namespace kiln::gui
