#include "robot/missions/fire/fire_belief.h"

#include <cmath>
#include <utility>

#include "common/core/units.h"

namespace kiln {

FireBelief initialFireBelief(const FireSiteMap& site) {
  FireBelief belief;
  for (const FirePlaceConfig& config : site.places) {
    FirePlace place;
    place.name = config.name;
    place.p_plate_map = {config.plate_xyz_m[0], config.plate_xyz_m[1], config.plate_xyz_m[2]};
    place.facing_rad = config.facing_deg * kDeg;
    belief.places.push_back(place);
  }
  return belief;
}

bool FireBelief::anyExtinguished() const {
  for (const FirePlace& place : places)
    if (place.extinguished) return true;
  return false;
}

int FireBelief::nextPlace() const {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!places[i].visited) return static_cast<int>(i);
  return -1;
}

const FirePlace* FireBelief::currentPlace() const {
  const int i = current_place;
  return i < 0 || i >= static_cast<int>(places.size()) ? nullptr
                                                       : &places[static_cast<std::size_t>(i)];
}

FirePlace* FireBelief::currentPlace() {
  return const_cast<FirePlace*>(std::as_const(*this).currentPlace());
}

Result<void> FireBelief::nudgePlace(std::size_t index, const Pose2& correction) {
  constexpr double kLargest_m = 1.0, kLargest_rad = M_PI / 6.0;
  if (index >= places.size())
    return makeError(ErrorCode::InvalidInput, "there is no fire place number {}", index + 1);
  const double way = std::hypot(correction.x_m, correction.y_m);
  if (!std::isfinite(way) || !std::isfinite(correction.yaw_rad))
    return makeError(ErrorCode::InvalidInput, "the correction of {} is not a number",
                     places[index].name);
  if (way > kLargest_m || std::abs(correction.yaw_rad) > kLargest_rad)
    return makeError(ErrorCode::Refused,
                     "{} would be moved by {:.2f} m and {:.0f} deg; at most 1 m and 30 deg at once",
                     places[index].name, way, correction.yaw_rad / kDeg);
  FirePlace& place = places[index];
  place.p_plate_map += Eigen::Vector3d(correction.x_m, correction.y_m, 0.0);
  place.facing_rad = wrapAngle(place.facing_rad + correction.yaw_rad);
  place.estimate.reset();
  place.visited = place.extinguished;
  ++place.nudges;
  place.nudge = {place.nudge.x_m + correction.x_m, place.nudge.y_m + correction.y_m,
                 wrapAngle(place.nudge.yaw_rad + correction.yaw_rad)};
  return {};
}

}  // namespace kiln
