#include "robot/scene/arena_map.h"

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

void SiteConfig::visit(ConfigArchive& a) {
  a.field("mission", mission, "whose site it is");
  a.field("file", file, "resource file of the site");
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
  a.list("sites", sites, "where missions work");
  a.list("geofence", geofence,
         "border of the arena, corners in order; the whole robot stays inside");
  a.field("geofence_x_min_m", geofence_x_min_m, "m", -1e3, 1e3, "the base centre stays inside");
  a.field("geofence_x_max_m", geofence_x_max_m, "m", -1e3, 1e3, "the base centre stays inside");
  a.field("geofence_y_min_m", geofence_y_min_m, "m", -1e3, 1e3, "the base centre stays inside");
  a.field("geofence_y_max_m", geofence_y_max_m, "m", -1e3, 1e3, "the base centre stays inside");
}

}  // namespace kiln
