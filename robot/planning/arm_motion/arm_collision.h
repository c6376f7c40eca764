#pragma once

#include <array>
#include <optional>
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
  std::vector<Capsule> links;     ///< as RobotGeometry::arm_shapes
  std::vector<OrientedBox> head;  ///< as RobotGeometry::head, then what is carried
};

inline constexpr const char* kGroundName = "ground";  ///< among the names of what may be touched

/// What stands around the arm beside the arena, as one motion has to see it.
struct ArmScene {
  std::vector<OrientedBox> boxes;  ///< in base: what moves with it, and what was measured from it
  /// Names of boxes, of the robot's body as well, or kGroundName, that head and carried body may touch
  /// on this motion: what is taken, and what it lies on or is set against. The other links keep clear
  /// of them all the same.
  std::vector<std::string> touchable;
};

/// The arm as the capsules and the head as the boxes of the robot's description, against the
/// robot's own body, itself, the ground and the known boxes around. Everything in base.
/// Thread-compatible; const calls are thread-safe.
class ArmCollision {
 public:
  explicit ArmCollision(const RobotGeometry& robot);
  /// Replaces the surroundings: boxes in map (ArenaMap walls, furniture, fire furniture), seen from
  /// X_map_base.
  void setScene(const std::vector<BoxConfig>& boxes_map, const Pose2& X_map_base,
                const ArmScene& more = {});
  /// A box fixed to the flange from now on, in flange axes: it counts as a part of the head, and
  /// keeps clear of the wrist as well. nullopt: nothing is carried.
  void setCarried(const std::optional<OrientedBox>& X_flange_box);
  /// Clearance of one posture. Distances above `interest_m` may be reported too small (never too
  /// large).
  [[nodiscard]] Clearance clearance(const Vector6d& q, double interest_m = 0.2) const;
  /// Same, without naming.
  [[nodiscard]] double distance(const Vector6d& q, double interest_m = 0.2) const;
  [[nodiscard]] ArmShapes shapesAt(const Vector6d& q) const;
  /// Of links[i]: how it is called, and whether it stands still with the base.
  [[nodiscard]] const std::string& nameOf(std::size_t i) const { return robot_.arm_shapes[i].name; }
  [[nodiscard]] bool standsStill(std::size_t i) const { return robot_.arm_shapes[i].link == 0; }
  /// How far any point of arm or head can move when the joints move by dq: metres, upper bound.
  [[nodiscard]] double motionBound(const Vector6d& dq) const;
  /// Does the straight joint move keep `clearance_m` all the way? Conservative advancement: no step
  /// is longer than any two parts have room for at its start, but at least 4 mm.
  [[nodiscard]] bool pathIsFree(const Vector6d& q_from, const Vector6d& q_to,
                                double clearance_m) const;

 private:
  struct Query;
  struct Boxes {
    std::vector<OrientedBox> kept_clear_of, touchable;
  };
  /// @param of_base  they stand still with the arm's column.
  void testBoxes(Query& query, const Boxes& boxes, bool of_base) const;
  void testBoxes(Query& query, const std::vector<OrientedBox>& boxes, bool of_base,
                 bool touchable) const;
  void testSelf(Query& query) const;
  void testGround(Query& query) const;
  void evaluate(Query& query, const Vector6d& q) const;
  void updateReach();

  RobotGeometry robot_;
  Eigen::Isometry3d X_base_armbase_;
  Boxes body_, scene_;
  std::vector<OrientedBox> head_in_flange_;
  bool ground_touchable_ = false;
  std::optional<OrientedBox> carried_in_flange_;
  std::vector<std::array<std::size_t, 2>> self_pairs_;  ///< of links that can meet
  Vector6d reach_;  ///< farthest point of arm or head from each joint's axis, m
};

}  // namespace kiln
