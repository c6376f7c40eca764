#include "robot/scene/arena_map.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln {
void GroundPoseConfig::visit(ConfigArchive& a) {
  a.field("xy_m", xy_m, "m", -1e3, 1e3, "position on the ground");
  a.field("yaw_deg", yaw_deg, "deg", -360, 360, "heading");
}

void GroundPointConfig::visit(ConfigArchive& a) {
  a.field("xy_m", xy_m, "m", -1e3, 1e3, "position on the ground");
}

Pose2 GroundPoseConfig::pose() const { return {xy_m[0], xy_m[1], yaw_deg * kDeg}; }

void FirePlaceConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for the operator");
  a.field("plate_xyz_m", plate_xyz_m, "m", -1e3, 1e3, "expected centre of the hot plate in map");
  a.field("facing_deg", facing_deg, "deg", -360, 360, "yaw of the plate's outward normal");
  a.section("work_pose", work_pose, "base pose for search and spray");
  a.list("via", via, "way-points from the hub to the work pose");
}

void ArenaMap::visit(ConfigArchive& a) {
  a.field("name", name, "for the operator");
  a.section("start", start, "nominal start pose");
  a.section("approach", approach, "ramp and edge before the building");
  a.list("walls", walls, "fixed structure");
  a.list("furniture", furniture, "roughly known boxes");
  a.section("doorway", doorway, "middle of the entrance, X into the building");
  a.list("entry_path", entry_path, "way-points from the start to the hub inside");
  a.list("mapping_path", mapping_path, "round of the mapping drive, back to the start");
  a.list("fire_places", fire_places, "known fire places, in the order of visits");
  a.list("geofence", geofence,
         "border of the arena, corners in order; the whole robot stays inside");
  a.field("geofence_x_min_m", geofence_x_min_m, "m", -1e3, 1e3, "the base centre stays inside");
  a.field("geofence_x_max_m", geofence_x_max_m, "m", -1e3, 1e3, "the base centre stays inside");
  a.field("geofence_y_min_m", geofence_y_min_m, "m", -1e3, 1e3, "the base centre stays inside");
  a.field("geofence_y_max_m", geofence_y_max_m, "m", -1e3, 1e3, "the base centre stays inside");
  a.field("box_size_m", box_size_m, "m", 0.1, 2, "edge of the acrylic box");
  a.field("opening_m", opening_m, "m", 0.02, 1, "diameter of the opening");
  a.field("plate_m", plate_m, "m", 0.02, 1, "diameter of the plate");
  a.field("recess_m", recess_m, "m", 0, 1, "plate behind the opening");
  a.field("table_size_m", table_size_m, "m", 0.1, 3, "edge of the table top");
  a.field("table_height_m", table_height_m, "m", 0.1, 2, "height of the table top");
}

Eigen::Isometry3d ArenaMap::front(const Eigen::Vector3d& p_plate_map, double facing_rad) const {
  return makePose(p_plate_map, {0, 0, facing_rad}) * Eigen::Translation3d(recess_m, 0, 0);
}

void ArenaMap::movePlace(std::size_t index, const Eigen::Vector3d& p_plate_map, double facing_rad) {
  FirePlaceConfig& place = fire_places[index];
  const Pose2 before{place.plate_xyz_m[0], place.plate_xyz_m[1], place.facing_deg * kDeg};
  const Pose2 after{p_plate_map.x(), p_plate_map.y(), facing_rad};
  const Pose2 work = after * inverse(before) * place.work_pose.pose();
  place.work_pose = {{work.x_m, work.y_m}, work.yaw_rad / kDeg};
  place.plate_xyz_m = {p_plate_map.x(), p_plate_map.y(), p_plate_map.z()};
  place.facing_deg = facing_rad / kDeg;
}

std::vector<BoxConfig> ArenaMap::fireFurniture() const {
  std::vector<BoxConfig> out;
  for (const FirePlaceConfig& place : fire_places) {
    const double yaw = place.facing_deg * kDeg;
    // The opening lies recess_m in front of the plate; the box extends box_size_m behind the
    // opening.
    const double back = 0.5 * box_size_m - recess_m;
    const double x = place.plate_xyz_m[0] - back * std::cos(yaw);
    const double y = place.plate_xyz_m[1] - back * std::sin(yaw);
    BoxConfig box{place.name + " box",
                  {{x, y, table_height_m + 0.5 * box_size_m}, {0, 0, place.facing_deg}},
                  {box_size_m, box_size_m, box_size_m}};
    const double table_back =
        0.5 * table_size_m - recess_m - 0.05;  // box front 5 cm behind the table's edge
    BoxConfig table{place.name + " table",
                    {{place.plate_xyz_m[0] - table_back * std::cos(yaw),
                      place.plate_xyz_m[1] - table_back * std::sin(yaw), 0.5 * table_height_m},
                     {0, 0, place.facing_deg}},
                    {table_size_m, table_size_m, table_height_m}};
    out.push_back(box);
    out.push_back(table);
  }
  return out;
}

}  // namespace kiln
