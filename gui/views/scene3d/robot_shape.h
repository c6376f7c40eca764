#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "common/robot_model/robot_geometry.h"

namespace kiln::gui {

/// One piece of the robot as it is drawn. Box: full lengths. Cylinder: along local Z, size =
/// (radius, radius, length), centred. Capsule: the same with round ends beyond the length.
struct RobotPart {
  enum class Form { Box, Cylinder, Capsule };
  enum class Role { Body, Tank, Wheel, Arm, Joint, Head, Nozzle };
  Form form = Form::Box;
  Role role = Role::Body;
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
};

/// Bob as simple solids, posed by joint and steering angles. The number and order of parts never
/// change, so that a renderer builds its meshes once and moves them.
class RobotShape {
 public:
  explicit RobotShape(const RobotGeometry& geometry);
  [[nodiscard]] const std::vector<RobotPart>& parts() const { return parts_; }
  /// X_base_part of every part, in the order of parts().
  /// @param q      arm joint angles, rad.
  /// @param steer  front-left, front-right, rear-left, rear-right, rad.
  [[nodiscard]] std::vector<Eigen::Isometry3d> poses(const Vector6d& q,
                                                     const std::array<double, 4>& steer) const;
  [[nodiscard]] const RobotGeometry& geometry() const { return geometry_; }

 private:
  RobotGeometry geometry_;
  std::vector<RobotPart> parts_;
};

}  // namespace kiln::gui
