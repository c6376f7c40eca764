#include "common/wire/fire/fire_model.h"

namespace kiln {

std::string_view toString(HeatRejection rejection) {
  switch (rejection) {
    case HeatRejection::None:
      return "none";
    case HeatRejection::TooCool:
      return "too cool";
    case HeatRejection::Reflection:
      return "reflection";
    case HeatRejection::Flame:
      return "flame";
    case HeatRejection::Frozen:
      return "frozen";
    case HeatRejection::TooSmall:
      return "too small";
    case HeatRejection::OutsideGeofence:
      return "outside geofence";
    case HeatRejection::NotLinear:
      return "not linear";
  }
  return "unknown";
}

std::string_view toString(PlaceVerdict verdict) {
  switch (verdict) {
    case PlaceVerdict::Fits:
      return "fits";
    case PlaceVerdict::Misplaced:
      return "misplaced";
    case PlaceVerdict::Unseen:
      return "unseen";
  }
  return "?";
}

Pose2 PlaceCheck::correction(double recess_m) const {
  if (!X_map_sensed) return {};
  const Pose2 X_front_plate{-recess_m, 0.0, 0.0};
  const Pose2 from = projectToGround(X_map_configured) * X_front_plate,
              to = projectToGround(*X_map_sensed) * X_front_plate;
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrapAngle(to.yaw_rad - from.yaw_rad)};
}

}  // namespace kiln
