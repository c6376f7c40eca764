#include "robot/scene/fire_site_map.h"

#include <algorithm>
#include <cmath>

#include "common/config/required_keys.h"
#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kTableAhead_m = 0.05;  ///< its edge before the front of the box

/// A box whose middle stands `back_m` behind the plate.
BoxConfig standing(const FirePlaceConfig& place, const std::string& name, double back_m, double z_m,
                   std::vector<double> size_m) {
  const double yaw = place.facing_deg * kDeg;
  return {place.name + " " + name,
          {{place.plate_xyz_m[0] - back_m * std::cos(yaw),
            place.plate_xyz_m[1] - back_m * std::sin(yaw), z_m},
           {0, 0, place.facing_deg}},
          std::move(size_m)};
}

}  // namespace

void FirePlaceConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for the operator");
  a.field("plate_xyz_m", plate_xyz_m, "m", -1e3, 1e3, "expected centre of the hot plate in map");
  a.field("facing_deg", facing_deg, "deg", -360, 360, "yaw of the plate's outward normal");
  a.section("work_pose", work_pose, "base pose for search and spray");
  a.list("via", via, "way-points from the hub to the work pose");
}

void FireSiteMap::visit(ConfigArchive& a) {
  a.list("places", places, "known fire places, in the order of visits");
  a.field("box_size_m", box_size_m, "m", 0.1, 2, "edge of the acrylic box");
  a.field("opening_m", opening_m, "m", 0.02, 1, "diameter of the opening");
  a.field("plate_m", plate_m, "m", 0.02, 1, "diameter of the plate");
  a.field("recess_m", recess_m, "m", 0, 1, "plate behind the opening");
  a.field("table_size_m", table_size_m, "m", 0.1, 3, "edge of the table top");
  a.field("table_height_m", table_height_m, "m", 0.1, 2, "height of the table top");
}

const FirePlaceConfig* FireSiteMap::place(const std::string& name) const {
  const auto found = std::find_if(places.begin(), places.end(),
                                  [&](const FirePlaceConfig& place) { return place.name == name; });
  return found == places.end() ? nullptr : &*found;
}

Eigen::Isometry3d FireSiteMap::front(const Eigen::Vector3d& p_plate_map, double facing_rad) const {
  return makePose(p_plate_map, {0, 0, facing_rad}) * Eigen::Translation3d(recess_m, 0, 0);
}

void FireSiteMap::movePlace(std::size_t index, const Eigen::Vector3d& p_plate_map,
                            double facing_rad) {
  FirePlaceConfig& place = places[index];
  const Pose2 before{place.plate_xyz_m[0], place.plate_xyz_m[1], place.facing_deg * kDeg};
  const Pose2 after{p_plate_map.x(), p_plate_map.y(), facing_rad};
  const Pose2 work = after * inverse(before) * place.work_pose.pose();
  place.work_pose = {{work.x_m, work.y_m}, work.yaw_rad / kDeg};
  place.plate_xyz_m = {p_plate_map.x(), p_plate_map.y(), p_plate_map.z()};
  place.facing_deg = facing_rad / kDeg;
}

SiteFixtures FireSiteMap::fixtures() const {
  SiteFixtures out;
  for (const FirePlaceConfig& place : places) {
    // The opening lies recess_m in front of the plate; the box extends box_size_m behind it.
    out.boxes.push_back(standing(place, "box", 0.5 * box_size_m - recess_m,
                                 table_height_m + 0.5 * box_size_m,
                                 {box_size_m, box_size_m, box_size_m}));
    out.boxes.push_back(standing(place, "table", 0.5 * table_size_m - recess_m - kTableAhead_m,
                                 0.5 * table_height_m,
                                 {table_size_m, table_size_m, table_height_m}));
    out.stands.push_back(place.work_pose);
    out.stands.insert(out.stands.end(), place.via.begin(), place.via.end());
  }
  return out;
}

Result<FireSiteMap> loadFireSite(const ArenaMap& arena) {
  for (const SiteConfig& site : arena.sites)
    if (site.mission == kFireSite) return loadComplete<FireSiteMap>(site.file, {"places"});
  return FireSiteMap{};
}

}  // namespace kiln
