#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/robot_model/robot_geometry.h"
#include "robot/planning/arm_motion/shapes.h"

namespace kiln {

/// How near the arm comes to anything, and what that is.
struct Clearance {
  double distance_m = 0.0;  ///< signed; a lower bound of the true distance
  std::string what;         ///< "forearm to tank left"
};

/// Arm and head at one posture, in base.
struct ArmShapes {
  std::array<Capsule, 8> links;  ///< six links, then the hose on upper arm and forearm
  std::vector<OrientedBox> head;
  /// "forearm"; of links[link].
  [[nodiscard]] static const char* nameOf(std::size_t link);
};

/// The arm as six capsules along its DH skeleton, the hose as two beside them and the head as
/// boxes, against the robot's own body, itself, the ground and the known boxes around. Everything
/// in base. Thread-compatible; const calls are thread-safe.
class ArmCollision {
 public:
  explicit ArmCollision(const RobotGeometry& robot);
  /// Replaces the surroundings: boxes in map (ArenaMap walls, furniture, fire furniture), seen from
  /// X_map_base.
  void setScene(const std::vector<BoxConfig>& boxes_map, const Pose2& X_map_base);
  /// Clearance of one posture. Distances above `interest_m` may be reported too small (never too
  /// large).
  [[nodiscard]] Clearance clearance(const Vector6d& q, double interest_m = 0.2) const;
  /// Same, without naming.
  [[nodiscard]] double distance(const Vector6d& q, double interest_m = 0.2) const;
  [[nodiscard]] ArmShapes shapesAt(const Vector6d& q) const;
  /// How far any point of arm or head can move when the joints move by dq: metres, upper bound.
  [[nodiscard]] double motionBound(const Vector6d& dq) const;
  /// Does the straight joint move keep `clearance_m` all the way? Conservative advancement: no step
  /// is longer than the room at its start allows, but at least 4 mm.
  [[nodiscard]] bool pathIsFree(const Vector6d& q_from, const Vector6d& q_to,
                                double clearance_m) const;

 private:
  struct Query;
  void testScene(Query& query) const;
  void testBody(Query& query) const;
  void testSelf(Query& query) const;
  void testGround(Query& query) const;
  [[nodiscard]] Query evaluate(const Vector6d& q, double interest_m) const;

  RobotGeometry robot_;
  Eigen::Isometry3d X_base_armbase_;
  std::vector<OrientedBox> body_, scene_, head_in_flange_;
  std::vector<double> radius_;
  Vector6d reach_;  ///< farthest point of arm or head from each joint's axis, m
};

}  // namespace kiln
