#include "robot/app/robot_localization.h"

#include <utility>

namespace kiln {
namespace {
constexpr std::size_t kMostCosts = 100'000;  // scans: nearly three hours
constexpr Duration kFirstFix = std::chrono::seconds(3);
}  // namespace

RobotLocalization::RobotLocalization(RobotBody& body, Location location)
    : body_(body),
      locator_(std::move(location.locator)),
      map_layer_(std::move(location.layer)),
      localizer_(body.settings.localization.localizerConfig(), body.arena, body.robot),
      motion_watch_(body.settings.motion_watch) {}

void RobotLocalization::forgetMatch() {
  map_fit_.reset();
  match_failure_.clear();
}

void RobotLocalization::reset(const Pose2& X_map_base, Stamp now) {
  localizer_.reset(X_map_base, now);
  forgetMatch();
}

void RobotLocalization::carriedToStart(Stamp now) {
  motion_watch_.restart();
  reset(body_.arena.start.pose(), now);
  carried_ = now;
}

void RobotLocalization::addOdometry(Stamp now) {
  const BaseTracking tracking = body_.base.tracking();
  // Also after a STOP: it may roll or be pushed, and the operator wants to know where it stands.
  const auto wheels = body_.devices.base.state();
  const bool stopped_and_heard =
      tracking.stop_latched && wheels &&
      toSeconds(now - wheels->stamp) <= body_.settings.base.max_state_age_s;
  if (tracking.ready || stopped_and_heard)
    localizer_.addOdometry(tracking.stamp, tracking.X_odom_base);
  update(now);
}

void RobotLocalization::addMatch(const PerceptionJobs::ScanResult& result) {
  if (!result.match) return;
  const Result<ScanMatch>& match = *result.match;
  const bool accepted = localizer_.addResult(result.prior, match);
  if (!match) {
    match_failure_ = match.error().message;
  } else if (!accepted) {
    match_failure_ = "the map fits elsewhere";
  } else {
    map_fit_ = MapFit{match->inlier_fraction, match->rms_m};
    match_failure_.clear();
  }
  if (match_costs_.size() < kMostCosts) match_costs_.push_back(static_cast<float>(result.locate_s));
}

std::string RobotLocalization::lostReason() const {
  return located() ? std::string() : "position lost: " + tracked_.reason;
}

std::string RobotLocalization::objection(Stamp now) {
  if (located()) {
    carried_.reset();
    return {};
  }
  return carried_ && now - *carried_ < kFirstFix ? std::string() : lostReason();
}

void RobotLocalization::monitorMotion(Stamp now) {
  // A recorded base moved by commands of then.
  if (body_.options.environment == Environment::Replay) return;
  const BaseTracking tracking = body_.base.tracking();
  body_.base.placeInMap(located() ? std::optional(tracked_.X_map_odom) : std::nullopt);
  if (!tracking.ready || body_.stop.latched()) {
    motion_watch_.restart();
    return;
  }
  const std::string wrong =
      motion_watch_.step({tracking.stamp, tracking.commanded, tracking.measured,
                          tracking.X_odom_base, located() ? std::optional(pose()) : std::nullopt});
  if (!wrong.empty()) (void)body_.stop.set(std::string(kMotionWatchSource) + wrong, now);
}

LocalizationStatus RobotLocalization::status() const {
  LocalizationStatus s;
  s.stamp = tracked_.stamp;
  s.health = tracked_.health == PoseHealth::Good       ? LocalizationHealth::Good
             : tracked_.health == PoseHealth::Degraded ? LocalizationHealth::Degraded
                                                       : LocalizationHealth::Lost;
  s.reason = tracked_.reason;
  s.method = body_.settings.localization.method;
  if (s.method == "surfel_map") s.submap = toString(localizer_.submap());
  s.X_map_base = tracked_.X_map_base_3d;
  s.X_map_odom = tracked_.X_map_odom;
  s.covariance = tracked_.covariance;
  s.sigma_m = tracked_.sigma_m;
  s.sigma_yaw_rad = tracked_.sigma_yaw_rad;
  s.match_age_s = tracked_.age_s;
  s.inlier_fraction = tracked_.inlier_fraction;
  s.observable_directions = tracked_.observable_directions;
  s.matches = tracked_.fixes;
  s.rejected = tracked_.rejected;
  s.resets = static_cast<int>(body_.belief.device_resets.value_or(0));
  return s;
}

}  // namespace kiln
