#pragma once

#include <vector>

#include "common/geom/pose.h"
#include "robot/planning/path_timing.h"

namespace kiln {

/// A smooth curve through joint space, sampled along a path coordinate (rad of the fastest joint,
/// or metres).
struct JointPath {
  std::vector<double> s;
  std::vector<Vector6d> q;
};

struct JointPathLimits {
  Vector6d speed = Vector6d::Ones();  ///< rad/s
  Vector6d accel = Vector6d::Ones();  ///< rad/s^2
  double path_speed = 1e6;            ///< of the path coordinate, 1/s
  double path_accel = 1e6;            ///< 1/s^2
  double jerk_time_s = 0.12;          ///< ramp of the acceleration
};

/// Straight move in joint space: all joints start and end together.
[[nodiscard]] JointPath straightJointPath(const Vector6d& q_from, const Vector6d& q_to);

/// The limits, slower along the path so that its motion lasts `duration_s`; as they are where they
/// make it last that long already. @pre the path has at least two samples; duration_s > 0.
[[nodiscard]] JointPathLimits slowedTo(const JointPath& path, JointPathLimits limits,
                                       double duration_s);

/// Timed, jerk-limited motion along joint paths, at rest between two of them. Joint speeds are kept
/// by slowing the path down where the joints must move much (near singularities).
/// Thread-compatible.
class JointTrajectory {
 public:
  struct Point {
    Vector6d q = Vector6d::Zero();
    Vector6d qd = Vector6d::Zero();
  };
  /// @pre each path has at least two samples.
  JointTrajectory(std::vector<JointPath> paths, const JointPathLimits& limits);
  [[nodiscard]] double duration() const { return duration_; }
  [[nodiscard]] Point at(double t_s) const;
  /// Share of the way, 0..1, that is covered at this time.
  [[nodiscard]] double covered(double t_s) const;
  [[nodiscard]] const Vector6d& goal() const { return pieces_.back().path.q.back(); }

 private:
  struct Piece {
    JointPath path;
    std::vector<Vector6d> tangent;  ///< dq/ds at each sample
    PathTiming timing;
    double start_s = 0.0;
  };
  [[nodiscard]] static Point along(const Piece& piece, const PathPoint& at);

  std::vector<Piece> pieces_;
  double duration_ = 0.0;
};

}  // namespace kiln
