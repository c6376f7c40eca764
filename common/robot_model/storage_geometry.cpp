#include "common/robot_model/storage_geometry.h"

#include "common/core/units.h"

namespace kiln {

void CompartmentConfig::visit(ConfigArchive& a) {
  a.field("name", name, "for messages");
  a.field("xyz_m", xyz_m, "m", -5, 5, "middle of the front edge of its floor in base, position 0");
  a.field("facing_deg", facing_deg, "deg", -360, 360, "yaw of its open front in base");
  a.field("incline_deg", incline_deg, "deg", 0, 45, "of the floor, backwards");
  a.field("bins", bins, "", 1, 20, "side by side");
  a.field("bin_width_m", bin_width_m, "m", 0.05, 1, "clear");
  a.field("bin_depth_m", bin_depth_m, "m", 0.05, 1, "of the floor");
  a.field("sheet_m", sheet_m, "m", 0.001, 0.05, "thickness of walls, back and floor");
  a.field("wall_height_m", wall_height_m, "m", 0.05, 3, "of walls and back");
  a.field("travel_min_m", travel_min_m, "m", -2, 0, "least position along Y");
  a.field("travel_max_m", travel_max_m, "m", 0, 2, "greatest position along Y");
  a.field("speed_mps", speed_mps, "m/s", 0.001, 1, "of its drive");
}

Eigen::Isometry3d CompartmentConfig::X_base_compartment(double position_m) const {
  return makePose({xyz_m[0], xyz_m[1], xyz_m[2]},
                  {0, incline_deg * kDeg, (facing_deg + 180.0) * kDeg}) *
         Eigen::Translation3d(0, position_m, 0);
}

std::vector<CompartmentBox> CompartmentConfig::boxes() const {
  const double t = sheet_m, d = bin_depth_m, h = wall_height_m, w = bins * pitch() + t;
  const auto at = [](double x, double y, double z) {
    return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
  };
  std::vector<CompartmentBox> out{{name + " floor", at(0.5 * (d + t), 0, -0.5 * t), {d + t, w, t}},
                                  {name + " back", at(d + 0.5 * t, 0, 0.5 * h), {t, w, h}}};
  for (int i = 0; i <= bins; ++i)
    out.push_back({name + " wall " + std::to_string(i + 1),
                   at(0.5 * d, (i - 0.5 * bins) * pitch(), 0.5 * h),
                   {d, t, h}});
  return out;
}

}  // namespace kiln
