#include "robot/missions/fire/skills/spray_calibration.h"

#include <algorithm>

#include "common/config/required_keys.h"

namespace kiln {
namespace {

/// Linear between the table's entries, proportional to the square of the distance outside.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto squared = [at](double x_edge, double y_edge) {
    return y_edge * (at / x_edge) * (at / x_edge);
  };
  if (at <= x.front()) return squared(x.front(), y.front());
  if (at >= x.back()) return squared(x.back(), y.back());
  const auto upper = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  const double s = (at - x[upper - 1]) / (x[upper] - x[upper - 1]);
  return (1.0 - s) * y[upper - 1] + s * y[upper];
}

}  // namespace

void SprayCalibration::visit(ConfigArchive& a) {
  a.field("exit_speed_mps", exit_speed_mps, "m/s", 1.0, 20.0, "speed at the nozzle at full flow");
  a.field("distance_m", distance_m, "m", 0.05, 5.0, "along the line of exit, ascending", false);
  a.field("drop_m", drop_m, "m", 0.0, 5.0, "below the line of exit, one for each distance", false);
  a.field("lateral_m", lateral_m, "m", -1.0, 1.0,
          "to the left of the line of exit, one for each distance", false);
  a.field("spread_deg", spread_deg, "deg", 0.0, 20.0, "rms of the jet's cone");
  a.field("empty_tank_fade", empty_tank_fade, "", 0.0, 0.9,
          "share of the flow lost as the tank empties");
}

Result<void> SprayCalibration::validate() const {
  if (distance_m.size() < 2 || drop_m.size() != distance_m.size() ||
      lateral_m.size() != distance_m.size())
    return makeError(ErrorCode::InvalidInput,
                     "spray calibration: distance_m, drop_m and lateral_m need equally many "
                     "entries, at least 2; "
                     "they have {}, {} and {}",
                     distance_m.size(), drop_m.size(), lateral_m.size());
  for (std::size_t i = 1; i < distance_m.size(); ++i)
    if (distance_m[i] <= distance_m[i - 1])
      return makeError(ErrorCode::InvalidInput,
                       "spray calibration: distance_m must ascend, but {} m follows {} m",
                       distance_m[i], distance_m[i - 1]);
  return {};
}

double SprayCalibration::dropAt(double at_m, double flow_scale) const {
  return interpolate(distance_m, drop_m, at_m) / (flow_scale * flow_scale);
}

double SprayCalibration::lateralAt(double at_m) const {
  return interpolate(distance_m, lateral_m, at_m);
}

double SprayCalibration::flowScale(double level) const {
  return 1.0 - empty_tank_fade * (1.0 - std::clamp(level, 0.0, 1.0));
}

Result<SprayCalibration> loadSprayCalibration(const std::string& resource) {
  auto loaded = loadComplete<SprayCalibration>(
      resource, {"exit_speed_mps", "distance_m", "drop_m", "lateral_m", "spread_deg"});
  if (!loaded) return loaded;
  if (auto valid = loaded->validate(); !valid) return tl::make_unexpected(valid.error());
  return loaded;
}

}  // namespace kiln
