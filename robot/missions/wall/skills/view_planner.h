#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "robot/perception/bricks/rough_pose.h"
#include "robot/perception/bricks/sweep_visibility.h"
#include "robot/planning/view_poses/lidar_view.h"

namespace kiln {

/// Pile or wall as it is expected before the sweeps.
struct ExpectedBricks {
  BrickTarget target;  ///< excluded bricks hide others and need not be seen
  /// Of X_base_target: x, y, yaw in base; m, rad. Zero: taken as it is.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// A sweep that was chosen.
struct PlannedView {
  LidarView view;
  SweepMotion motion;
  std::vector<double> cells;  ///< of each brick, expected to be found by this sweep alone
};

/// The sweeps from one place of the base, in the order of their worth.
struct ViewPlan {
  std::vector<PlannedView> views;
  std::vector<double> cells;           ///< of each brick, expected by all of them together
  std::vector<std::size_t> uncovered;  ///< wanted bricks that stay below what perception needs
  int considered = 0;                  ///< views of the fan
  int unreachable = 0;  ///< of those that were asked for, the arm cannot make so many
  std::string why;      ///< of the last one
};

/// Chooses the few sweeps that show all bricks that can be seen: from a fan of places and heights of
/// the LiDAR, one after the other, that which adds most bricks found well enough by expectation over
/// the target's pose (its covariance by sigma points), until all are covered or no sweep adds one.
/// The tilt of each spans what it has to show, so that its lines lie as close as the time allows.
/// The same question has the same answer. Confined to one thread.
class ViewPlanner {
 public:
  struct Config {
    int max_views = 3;
    double duration_s = 4.2;  ///< of one motion; the scans of rest at its ends make it 5 s at most
    double margin_deg = 2.0;  ///< of tilt above and below the bricks
    double min_span_deg = 12.0, max_span_deg = 50.0;  ///< of tilt
    double needed_cells = 0.0;  ///< found of a brick; 0: cellsNeeded() of brick perception
    double min_gain = 0.05;     ///< of one brick; a further sweep that adds less is not made
    double sigmas = 2.0;        ///< of the poses that are tried (unscented transform)
    int instants = 9;           ///< of a motion, for the expectation
    /// The fan: places of the LiDAR about the arm's mount, in its own axes turned to the bricks.
    std::vector<double> ahead_m{0.55, 0.3, 0.8};
    std::vector<double> aside_m{0.0, 0.4, -0.4, 0.7, -0.7};
    std::vector<double> up_m{0.9, 1.2, 0.6};
    /// Of the first look.
    double look_from_deg = -4.0, look_to_deg = 16.0;
    SweepMotionLimits limits;
    SweepVisibility::Config visibility;
    void visit(ConfigArchive& a);
  };
  /// Can the arm make this sweep, and how? Error: why not.
  using Reach = std::function<Result<SweepMotion>(const LidarView& view)>;
  ViewPlanner(const Config& config, const RobotGeometry& robot);

  /// @return Error{InvalidInput}: no brick is wanted, or the pose is not finite.
  [[nodiscard]] Result<ViewPlan> plan(const ExpectedBricks& expected, const Reach& reach) const;
  /// The views that are considered: each place of the fan looks at the middle of the bricks.
  [[nodiscard]] std::vector<LidarView> fan(const ExpectedBricks& expected) const;
  /// What these views are expected to show, whether or not the arm can make them; a plan without
  /// motions, for comparison. @pre as plan()
  [[nodiscard]] ViewPlan assess(const ExpectedBricks& expected,
                                const std::vector<LidarView>& views) const;
  /// How the arm looks around for a target that stands anywhere ahead, or why it cannot.
  [[nodiscard]] Result<SweepMotion> firstLook(const Reach& reach) const;
  /// By kinematics and collision among `world`, near to `q_near`.
  [[nodiscard]] Reach reachOf(const ArmCollision& world, const Vector6d& q_near) const;
  [[nodiscard]] double neededCells() const;

 private:
  class Search;
  Config config_;
  const RobotGeometry& robot_;
};

}  // namespace kiln
