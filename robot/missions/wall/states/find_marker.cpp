#include "robot/missions/wall/states/find_marker.h"

#include <cmath>

#include <fmt/format.h>

#include "common/core/units.h"
#include "robot/missions/wall/looking_posture.h"
#include "robot/missions/wall/states/drive_to_marker.h"
#include "robot/missions/wall/states/drive_to_wall.h"
#include "robot/missions/wall/states/wall_given_up.h"
#include "robot/missions/wall/states/wall_surveyed.h"

namespace kiln {

void FindMarker::enter() {
  WallContext& c = context();
  postures_.clear();
  next_ = 0;
  rests_since_.reset();
  double side = 1.0;  // there and back, a line at each tilt
  for (const double tilt_deg : c.config.marker_look.tilt_deg) {
    const int stops = c.config.marker_look.stops;
    for (int k = 0; k < stops; ++k) {
      const double share = stops > 1 ? side * (1.0 - 2.0 * k / (stops - 1)) : 0.0;
      postures_.push_back(
          lookingPosture(share * c.config.marker_look.pan_deg * kDeg, tilt_deg * kDeg));
    }
    side = -side;
  }
  c.marker.clear();
  if (!postures_.empty()) c.parts.arm.startJoints(postures_.front(), now());
}

Transition FindMarker::execute() {
  WallContext& c = context();
  c.marker.tick();
  if (c.marker.answer()) return conclude(*c.marker.answer());
  return next_ < postures_.size() ? look() : stay();
}

Transition FindMarker::look() {
  WallContext& c = context();
  display(fmt::format("looking for the marker: {} of {} pictures show it", c.marker.candidates(),
                      c.marker.pictures()));
  if (!rests_since_) {
    const SkillStatus arm = c.parts.arm.poll(now());
    if (arm.phase == SkillPhase::Failed) return again("the head cannot be moved: " + arm.text);
    if (arm.phase != SkillPhase::Done) return stay();
    if (next_ == 0) c.marker.begin(now());
    rests_since_ = now();
  }
  if (toSeconds(now() - *rests_since_) < c.config.marker_look.rest_s) return stay();
  rests_since_.reset();
  ++next_;
  if (next_ < postures_.size())
    c.parts.arm.startJoints(postures_[next_], now());
  else
    c.marker.ask();
  return stay();
}

Transition FindMarker::conclude(const MarkerSearch& search) {
  WallContext& c = context();
  if (!search.estimate)
    return again(search.refused.empty() ? "nothing was seen" : search.refused.front().text);
  const MarkerEstimate& found = *search.estimate;
  const auto body = c.parts.body_at(found.stamp);
  if (!body) return again("the robot's pose was not known when the picture was taken");
  const Pose2 X_map_odom = body->X_map_base * inverse(body->X_odom_base);
  const Pose2 X = X_map_odom * found.X_odom_wall;
  const Pose2 prior = c.site.marker.pose();
  const double off_m = std::hypot(X.x_m - prior.x_m, X.y_m - prior.y_m);
  const double allowed_m = 2.0 * c.site.known_m + 0.5;
  if (off_m > allowed_m)
    return again(
        fmt::format("what was found lies {:.1f} m from where the marker is known to be, "
                    "{:.1f} m may",
                    off_m, allowed_m));
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(X_map_odom.yaw_rad).toRotationMatrix();
  c.belief.wall = {X, turn * found.covariance * turn.transpose()};
  c.siteMoved();
  const std::string where =
      fmt::format("marker at ({:.2f}, {:.2f}) m by {} pictures", X.x_m, X.y_m, found.pictures);
  if (c.builds()) return transit<DriveToWall>().because(where);
  return transit<WallSurveyed>().because(where);
}

Transition FindMarker::again(const std::string& why) {
  const WallContext& c = context();
  if (c.belief.marker_looks < c.config.marker_look.max_looks)
    return transit<DriveToMarker>().because("not found: " + why);
  return transit<WallGivenUp>().because(
      fmt::format("the marker was not found in {} looks: {}", c.belief.marker_looks, why));
}

}  // namespace kiln
