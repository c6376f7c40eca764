#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/core/error.h"
#include "common/geom/pose.h"
#include "common/wire/fire/fire_model.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {

/// What is known of one configured fire place, and what was tried there.
struct FirePlace {
  std::string name;
  /// Plate centre as configured, and as the operator has nudged it; m.
  Eigen::Vector3d p_plate_map = Eigen::Vector3d::Zero();
  double facing_rad = 0.0;    ///< yaw of the opening's outward normal, likewise
  int nudges = 0;             ///< by the operator, since the mission began
  Pose2 nudge;                ///< what they add up to: (x, y) in map, yaw about the plate
  bool visited = false;       ///< done with it in this round
  bool extinguished = false;  ///< all its water was delivered (estimated)
  std::optional<FireEstimate> estimate;
  double litres_est = 0.0;  ///< sprayed here, pump model x time
  int searches = 0;
  int losses = 0;  ///< target lost while aiming
  int pump_faults = 0;
  int arm_faults = 0;
  int drive_faults = 0;
  std::string outcome;  ///< for report and operator
};

/// What the fire mission knows and what survives a restart of it. `map`, metres, radians, litres.
struct FireBelief {
  std::vector<FirePlace> places;
  int current_place = -1;  ///< index into places; -1 = none selected
  int at_place = -1;       ///< the base last arrived at the work pose of this place; -1 = none
  int search_round = 1;
  bool inside = false;  ///< the entry path was driven to its end
  double sprayed_l_est = 0.0;
  std::array<double, 2> tank_l_est{5.0, 5.0};
  /// A pump that repeatedly drew no current is left out.
  std::array<bool, 2> pump_usable{true, true};
  int entry_faults = 0;    ///< failed drives into the building since the last reset
  int blocked_in_row = 0;  ///< arm faults since a drive last succeeded

  [[nodiscard]] bool anyExtinguished() const;
  /// Index of the first place not visited in this round, or -1.
  [[nodiscard]] int nextPlace() const;
  /// nullptr when no place is selected.
  [[nodiscard]] FirePlace* currentPlace();
  [[nodiscard]] const FirePlace* currentPlace() const;
  /// The operator's correction of where a place stands: shifted by (x, y) in map and turned by yaw
  /// about its plate. What was seen of its fire before is forgotten, and it may be visited anew.
  /// Error: Refused for more than 1 m or 30 deg at once (a mistake, not a nudge), InvalidInput for
  /// an unknown place or a correction that is not finite.
  [[nodiscard]] Result<void> nudgePlace(std::size_t index, const Pose2& correction);
};

/// The arena's places, nothing known of them.
[[nodiscard]] FireBelief initialFireBelief(const FireSiteMap& site);

[[nodiscard]] nlohmann::json fireBeliefToJson(const FireBelief& belief);
/// @param places  how many the arena has.
/// Error{InvalidInput}: names the first key that is missing, of the wrong type or out of range.
[[nodiscard]] Result<FireBelief> fireBeliefFromJson(const nlohmann::json& json, std::size_t places);

}  // namespace kiln
