#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/sim/magnet_rule.h"
#include "robot/sim/true_arena.h"

struct mjModel_;
struct mjData_;

namespace kiln::sim {

/// One brick at an instant.
struct BrickState {
  Eigen::Isometry3d X_map_brick = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();    ///< of its middle, map
  Eigen::Vector3d w_radps = Eigen::Vector3d::Zero();  ///< brick
  bool frozen = false;
  [[nodiscard]] bool atRest() const;
};

/// What gripper and bricks do to each other.
struct GripState {
  std::optional<std::size_t> held;     ///< the brick that the rule holds fast
  std::optional<std::size_t> touched;  ///< the brick on which the face presses
  MagnetTouch touch;                   ///< of the brick before the face
  /// Of weld and magnets on the flange, contacts of the face apart: N and Nm in map, torque about
  /// p_map.
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero(), torque_nm = Eigen::Vector3d::Zero(),
                  p_map = Eigen::Vector3d::Zero();
};

/// The bricks among Physics' bodies: magnets, the weld that stands for a grip which holds, and
/// freezing. A frozen brick is put back where it was after each step, and a twin of unlimited mass
/// stands in its place for what is awake (simulation.md section 1.3). Nothing moves by itself
/// between freezing and thawing, so no sensor sees a difference. Thread-compatible.
class BrickBodies {
 public:
  /// @param model, data  outlive it; from mjcf() of the same arena.
  BrickBodies(mjModel_* model, mjData_* data, const WorldConfig& config, const TrueArena& arena,
              const RobotGeometry& robot);
  ~BrickBodies();

  void setFields(const std::array<double, kMagnets>& fields) { fields_ = fields; }
  [[nodiscard]] std::size_t size() const { return bodies_.size(); }
  [[nodiscard]] BrickState state(std::size_t brick) const;
  [[nodiscard]] bool frozen(std::size_t brick) const { return bodies_[brick].frozen; }
  [[nodiscard]] const GripState& grip() const { return grip_; }
  [[nodiscard]] std::size_t awake() const;
  /// Of a geom; nullopt: no brick.
  [[nodiscard]] std::optional<std::size_t> brickOf(int geom) const;
  [[nodiscard]] bool isFace(int geom) const { return geom == face_geom_; }

  // In the order in which Physics calls them, each step.
  /// After positions are known and before forces act.
  void pull();
  /// The step was taken: forgets contacts of the last one.
  void beginContacts();
  /// A contact of a brick with anything. @param force_n on that brick, map
  void noteContact(std::size_t brick, int other_geom, const Eigen::Vector3d& force_n,
                   const Eigen::Vector3d& p_map);
  /// Judges the grip, puts frozen bricks back, freezes and thaws.
  void settle(double step_s);

  // When people carry the robot.
  void letGo();
  /// Poses and motions, apart from mj_resetData.
  [[nodiscard]] std::vector<double> save() const;
  void restore(const std::vector<double>& saved);
  /// Moves a brick, at rest.
  void place(std::size_t brick, const Eigen::Isometry3d& X_map_brick);

 private:
  struct Body {
    int body = 0, geom = 0, twin_geom = 0, twin_mocap = 0, qpos = 0, qvel = 0, weld = 0;
    bool frozen = false;
    double rest_s = 0.0;
    Eigen::Isometry3d X_frozen = Eigen::Isometry3d::Identity();
    // Contacts of this step, those of the face apart.
    Eigen::Vector3d force_n = Eigen::Vector3d::Zero(), torque_nm = Eigen::Vector3d::Zero();
    bool face = false;
  };
  [[nodiscard]] Eigen::Isometry3d X_map_tool() const;
  [[nodiscard]] std::optional<MagnetTouch> touchOf(std::size_t brick,
                                                   const Eigen::Isometry3d& X_map_tool) const;
  /// What this brick does to the face, from its own motion and its other contacts.
  [[nodiscard]] GripLoad loadOf(std::size_t brick, const Eigen::Isometry3d& X_map_tool) const;
  void judge(double step_s);
  void weld(std::size_t brick);
  void unweld();
  void showAwake(Body& body);
  void freeze(Body& body);
  void thaw(Body& body);
  void putBack(Body& body);
  void freezeAndThaw(double step_s);
  [[nodiscard]] Eigen::AlignedBox3d boxAround(int geom) const;

  mjModel_* m_;
  mjData_* d_;
  WallConfig config_;
  std::vector<TrueBrick> bricks_;
  Eigen::Isometry3d X_flange_tool_;
  std::vector<Body> bodies_;
  std::vector<int> brick_of_geom_;  ///< -1: none
  std::vector<int> robot_geoms_;
  int flange_body_ = 0, face_geom_ = 0;
  std::array<double, kMagnets> fields_{};
  GripState grip_;
  int held_steps_ = 0;      ///< in which the rule would hold what touches
  double no_weld_s_ = 0.0;  ///< after the rule let go
  double check_s_ = 0.0;
};

}  // namespace kiln::sim
