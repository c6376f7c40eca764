#include "robot/missions/fire/skills/search_rectangle.h"

namespace kiln {

void SearchConfig::visit(ConfigArchive& a) {
  a.field("standoff_m", standoff_m, "m", 0.3, 3.0, "camera to the expected plate");
  a.field("standoff_step_m", standoff_step_m, "m", 0.02, 0.5,
          "variation when a pose cannot be reached");
  a.field("half_width_m", half_width_m, "m", 0.0, 1.0, "of the search rectangle");
  a.field("half_height_m", half_height_m, "m", 0.0, 1.0, "of the search rectangle");
  a.field("smallest_scale", smallest_scale, "", 0.1, 1.0, "to which the rectangle may shrink");
}

Eigen::Isometry3d lookAt(const Eigen::Vector3d& p, const Eigen::Vector3d& p_target) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = p;
  const Eigen::Vector3d viewing = (p_target - p).normalized();
  const Eigen::Vector3d right = viewing.cross(Eigen::Vector3d::UnitZ()).normalized();
  X.linear().col(0) = right;
  X.linear().col(1) = viewing.cross(right);
  X.linear().col(2) = viewing;
  return X;
}

std::vector<Eigen::Isometry3d> searchRectangle(const Eigen::Vector3d& p_place_map,
                                               const Eigen::Vector3d& normal_map, double standoff_m,
                                               double half_width_m, double half_height_m) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d left = up.cross(-normal_map).normalized();  // as seen from the camera
  const Eigen::Vector3d middle = p_place_map + standoff_m * normal_map;
  std::vector<Eigen::Isometry3d> out;
  for (const auto& [side, height] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}})
    out.push_back(
        lookAt(middle + side * half_width_m * left + height * half_height_m * up, p_place_map));
  out.push_back(lookAt(middle, p_place_map));
  return out;
}

}  // namespace kiln
