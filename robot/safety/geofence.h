#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"

namespace kiln {

/// The arena's border for the whole robot: a polygon in map in which the footprint, grown by a
/// margin, must stay. Limits commands before the wheels see them, whoever gives them (NimbRo UGV
/// paper: a faulty controller drove the robot towards the arena boundary). Thread-compatible; const
/// calls are thread-safe.
class Geofence {
 public:
  struct Config {
    double margin_m = 0.10;    ///< around the footprint
    double decel_mps2 = 0.7;   ///< planned braking before the border
    double reaction_s = 0.25;  ///< until the base follows
    void visit(ConfigArchive& a);
  };
  /// What is left of a command.
  struct Limited {
    Twist2 twist;
    bool limited = false;
    std::string reason;  ///< "the fence is 0.2 m ahead"; empty if nothing was taken away
  };
  /// @param corners_map  at least three, in order (either way round), not crossing itself; the
  /// polygon may be concave. Error: InvalidInput, in words.
  [[nodiscard]] static Result<Geofence> create(const Config& config,
                                               std::vector<Eigen::Vector2d> corners_map,
                                               double footprint_length_m, double footprint_width_m);

  /// Room between the grown footprint and the border, metres; negative when it reaches over.
  [[nodiscard]] double room(const Pose2& X_map_base) const;
  [[nodiscard]] bool inside(const Pose2& X_map_base) const { return room(X_map_base) >= 0.0; }
  /// Scales a command down so that the robot can still stop inside; to zero at the border. A robot
  /// that is outside may move only so that its room grows: it can be driven back by hand.
  /// A pose that is not finite leaves nothing of the command.
  [[nodiscard]] Limited limit(const Twist2& wish, const Pose2& X_map_base) const;

 private:
  Geofence() = default;
  [[nodiscard]] double toBorder(const Eigen::Vector2d& p) const;  ///< signed, positive inside

  Config config_;
  std::vector<Eigen::Vector2d> corners_;
  std::vector<Eigen::Vector2d> outline_base_;  ///< points along the grown footprint's edge
};

}  // namespace kiln
