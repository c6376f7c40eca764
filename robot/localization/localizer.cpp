#include "robot/localization/localizer.h"

#include <algorithm>
#include <cmath>

#include "common/core/log.h"
#include "common/core/units.h"

namespace kiln {
namespace {

bool agree(const Pose2& a, const Pose2& b, double within_m, double within_deg) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) <= within_m &&
         std::abs(wrapAngle(a.yaw_rad - b.yaw_rad)) <= within_deg * kDeg;
}

}  // namespace

void Localizer::Config::visit(ConfigArchive& a) {
  a.field("switch_before_door_m", switch_before_door_m, "m", 0, 20,
          "indoor map from this far outside the doorway on");
  a.field("switch_back_m", switch_back_m, "m", 0, 20, "outdoor map again from here");
  a.field("relocate_spacing_m", relocate_spacing_m, "m", 0.2, 10,
          "distance of the places searched over the arena when lost");
  a.field("relocate_step_deg", relocate_step_deg, "deg", 5, 90, "headings tried at each");
  a.field("confirm_m", confirm_m, "m", 0.01, 1, "a second scan must agree so well");
  a.field("confirm_deg", confirm_deg, "deg", 0.1, 20, "the same for the heading");
  a.field("confirm_inlier_fraction", confirm_inlier_fraction, "", 0, 1,
          "share of the scan that the map must explain then");
  a.section("tracker", tracker, "odometry and fixes");
}

Localizer::Localizer(const Config& config, const ArenaMap& arena, const RobotGeometry& robot)
    : config_(config),
      arena_(arena),
      robot_(robot),
      ground_(arena.approach),
      tracker_(config.tracker) {}

Eigen::Isometry3d Localizer::onNominalGround(const Pose2& X_map_base) const {
  return ground_.standing(X_map_base, robot_);
}

Submap Localizer::submapAt(const Pose2& X_map_base, Submap current) const {
  const Pose2 X_door_base = inverse(arena_.doorway.pose()) * X_map_base;
  if (X_door_base.x_m > -config_.switch_before_door_m) return Submap::Indoor;
  return X_door_base.x_m < -config_.switch_back_m ? Submap::Outdoor : current;
}

void Localizer::reset(const Pose2& X_map_base, Stamp now) {
  tracker_.reset(onNominalGround(X_map_base), now);
  submap_ = submapAt(X_map_base, Submap::Outdoor);
  places_.clear();
  candidate_.reset();
  tries_ = 0;
}

void Localizer::addOdometry(Stamp stamp, const Pose2& X_odom_base) {
  tracker_.addOdometry(stamp, X_odom_base);
  now_ = stamp;
  const TrackedPose pose = tracker_.pose(stamp);
  const Submap before = submap_;
  submap_ = submapAt(pose.X_map_base, submap_);
  if (submap_ != before) logger("localization")->info("now on the {} map", toString(submap_));
}

/// Where a lost robot may be, likeliest first: where it works, then all over the arena.
std::vector<Pose2> Localizer::placesToSearch() const {
  std::vector<Pose2> places{arena_.start.pose()};
  for (const GroundPoseConfig& via : arena_.entry_path) places.push_back(via.pose());
  for (const auto& [mission, site] : arena_.fixtures)
    for (const GroundPoseConfig& stand : site.stands) places.push_back(stand.pose());
  const double step = config_.relocate_spacing_m;
  for (double turn = 0.0; turn < 359.0; turn += config_.relocate_step_deg) {
    for (double x = arena_.geofence_x_min_m + 0.5 * step; x < arena_.geofence_x_max_m; x += step) {
      for (double y = arena_.geofence_y_min_m + 0.5 * step; y < arena_.geofence_y_max_m; y += step)
        places.push_back({x, y, wrapAngle(turn * kDeg)});
    }
  }
  return places;
}

std::optional<AlignmentPrior> Localizer::priorAt(Stamp t) {
  auto prior = tracker_.priorAt(t);
  if (!prior) return std::nullopt;
  prior->submap = submap_;
  if (!prior->search) {
    tries_ = 0;
    return prior;
  }
  if (candidate_) {  // look again where the last scan seemed to fit
    prior->X_map_base =
        candidate_->X_map_base * inverse(candidate_->X_odom_base) * prior->X_odom_base;
    prior->X_map_base_3d = candidate_->X_map_base_3d;
    prior->submap = candidate_->submap;
    prior->elsewhere = true;
    return prior;
  }
  const TrackedPose pose = tracker_.pose(now_.value_or(t));
  if (pose.health != PoseHealth::Lost || tries_++ % 4 == 0) return prior;
  if (places_.empty()) {
    places_ = placesToSearch();
    std::reverse(places_.begin(), places_.end());  // taken from the back
  }
  prior->X_map_base = places_.back();
  prior->X_map_base_3d = onNominalGround(places_.back());
  prior->submap = submapAt(places_.back(), Submap::Outdoor);
  prior->elsewhere = true;
  places_.pop_back();
  return prior;
}

/// What was found far from the belief must be found again by the next scan: one wall looks like
/// another.
void Localizer::confirm(const AlignmentPrior& prior, const ScanMatch& match) {
  const Pose2 found = projectToGround(match.X_map_base);
  if (match.inlier_fraction < config_.confirm_inlier_fraction) {
    candidate_.reset();
    return;
  }
  if (candidate_ && agree(found, prior.X_map_base, config_.confirm_m, config_.confirm_deg)) {
    candidate_.reset();
    places_.clear();
    tries_ = 0;
    submap_ = submapAt(found, prior.submap);
    if (tracker_.addFix(prior, match)) {
      logger("localization")
          ->warn("position found again: x {:.2f} m, y {:.2f} m, {:.0f} deg; {:.0f} % explained",
                 found.x_m, found.y_m, found.yaw_rad / kDeg, 100.0 * match.inlier_fraction);
    }
    return;
  }
  candidate_ = prior;
  candidate_->X_map_base = found;
  candidate_->X_map_base_3d = match.X_map_base;
}

bool Localizer::addResult(const AlignmentPrior& prior, const Result<ScanMatch>& match) {
  if (!match) {
    if (prior.elsewhere) candidate_.reset();
    tracker_.addFailure(prior, match.error().message);
    return false;
  }
  if (prior.elsewhere) {
    const std::uint64_t before = tracker_.pose(prior.stamp).fixes;
    confirm(prior, *match);
    return tracker_.pose(prior.stamp).fixes != before;
  }
  const bool lost = prior.search && tracker_.pose(prior.stamp).health == PoseHealth::Lost;
  if (!tracker_.addFix(prior, *match)) return false;
  if (lost) {
    const Pose2 found = projectToGround(match->X_map_base);
    logger("localization")
        ->warn("position found: x {:.2f} m, y {:.2f} m, {:.0f} deg; {:.0f} % explained", found.x_m,
               found.y_m, found.yaw_rad / kDeg, 100.0 * match->inlier_fraction);
  }
  return true;
}

}  // namespace kiln
