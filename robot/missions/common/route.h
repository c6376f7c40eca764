#pragma once

#include <optional>
#include <vector>

#include "common/geom/pose.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// True when a disc of `radius_m` can move straight from a to b without touching walls, furniture
/// or what stands at a site of the nominal map.
[[nodiscard]] bool straightIsClear(const ArenaMap& arena, const Pose2& a, const Pose2& b,
                                   double radius_m);

/// Leaves out way-points between which the straight line is clear; the last one always stays.
[[nodiscard]] std::vector<Pose2> shortened(const ArenaMap& arena, const Pose2& from,
                                           const std::vector<Pose2>& route, double radius_m);

/// The way-points of a polyline that still lie ahead of `here`: a resume in the middle of a drive
/// does not turn back.
/// @param start  where the polyline begins.
[[nodiscard]] std::vector<Pose2> remaining(const Pose2& start, const std::vector<Pose2>& route,
                                           const Pose2& here);

/// Where to back up to before a drive from `here` towards `to`: from rest a wheel that stands
/// against the edge of the approach spins and does not climb. nullopt: none does.
[[nodiscard]] std::optional<Pose2> runUp(const ApproachConfig& approach, const RobotGeometry& robot,
                                         const Pose2& here, const Pose2& to);

}  // namespace kiln
