#include "robot/missions/fire/fire_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace kiln {

using nlohmann::json;

void FireReport::addEstimate(const std::optional<FireEstimate>& estimate, Stamp image,
                             const Eigen::Isometry3d& X_map_thermal) {
  if (!estimate || estimate->stamp != image) return;
  if (!heat_.empty() && image <= heat_.back().stamp) return;
  heat_.push_back({image, X_map_thermal.inverse() * estimate->p_map, estimate->range_m,
                   estimate->baseline_range_m, estimate->views, estimate->place});
}

void FireReport::addPlaceCheck(const PlaceCheck& check) {
  const auto same = [&](const PlaceCheck& known) {
    return known.stamp == check.stamp && known.place == check.place;
  };
  if (std::none_of(checks_.begin(), checks_.end(), same)) checks_.push_back(check);
}

void FireReport::write(json& report) const {
  json heat = json::array();
  for (const HeatRecord& record : heat_) {
    heat.push_back(
        {{"t", toSeconds(record.stamp)},
         {"p_thermal", {record.p_thermal.x(), record.p_thermal.y(), record.p_thermal.z()}},
         {"range_m", record.range_m},
         {"baseline_range_m", record.baseline_range_m},
         {"views", record.views},
         {"place", record.place}});
  }
  json checks = json::array();
  for (const PlaceCheck& check : checks_) {
    json entry{{"t", toSeconds(check.stamp)},
               {"place", check.place},
               {"verdict", toString(check.verdict)},
               {"offset_m", check.offset_m},
               {"yaw_offset_rad", check.yaw_offset_rad},
               {"coverage", check.coverage},
               {"points", check.points}};
    if (check.X_map_sensed) {
      const Pose2 sensed = projectToGround(*check.X_map_sensed);
      entry["sensed"] = {sensed.x_m, sensed.y_m, sensed.yaw_rad};
    }
    checks.push_back(entry);
  }
  report["heat_estimates"] = std::move(heat);
  report["place_checks"] = std::move(checks);
}

}  // namespace kiln
