#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/geom/pose.h"
#include "common/model/fire.h"

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

/// Everything that the mission knows and that survives a restart. `map`, metres, radians.
struct WorldState {
  bool clock_started = false;
  Stamp clock_start;  ///< robot time at which the mission clock began
  int resets = 0;
  std::vector<FirePlace> places;
  int current_place = -1;  ///< index into places; -1 = none selected
  int at_place = -1;       ///< the base last arrived at the work pose of this place; -1 = none
  int search_round = 1;
  bool inside = false;  ///< the entry path was driven to its end
  Pose2 X_map_base;     ///< newest known pose
  Stamp pose_stamp;
  double sprayed_l_est = 0.0;
  std::array<double, 2> tank_l_est{5.0, 5.0};
  std::array<bool, 2> pump_usable{true,
                                  true};  ///< a pump that repeatedly drew no current is left out
  int entry_faults = 0;                   ///< failed drives into the building since the last reset
  int blocked_in_row = 0;                 ///< arm faults since a drive last succeeded

  /// Seconds on the mission clock; 0 before its start. It runs on through pauses and resets.
  [[nodiscard]] double elapsedS(Stamp now) const {
    return clock_started ? toSeconds(now - clock_start) : 0.0;
  }
  [[nodiscard]] bool anyExtinguished() const;
  /// Index of the first place not visited in this round, or -1.
  [[nodiscard]] int nextPlace() const;
};

}  // namespace kiln
