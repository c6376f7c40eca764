#include "robot/world_model/world_model.h"

#include <cmath>

namespace kiln {

bool WorldState::anyExtinguished() const {
  for (const FirePlace& place : places)
    if (place.extinguished) return true;
  return false;
}

int WorldState::nextPlace() const {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!places[i].visited) return static_cast<int>(i);
  return -1;
}

WorldModel::WorldModel(WorldState initial) : state_(std::move(initial)) { publish(); }

FirePlace* WorldModel::currentPlace() {
  const int i = state_.current_place;
  return i < 0 || i >= static_cast<int>(state_.places.size())
             ? nullptr
             : &state_.places[static_cast<std::size_t>(i)];
}

const FirePlace* WorldModel::currentPlace() const {
  return const_cast<WorldModel*>(this)->currentPlace();
}

Result<void> WorldModel::nudgePlace(std::size_t index, const Pose2& correction) {
  constexpr double kLargest_m = 1.0, kLargest_rad = M_PI / 6.0;
  if (index >= state_.places.size())
    return makeError(ErrorCode::InvalidInput, "there is no fire place number {}", index + 1);
  const double way = std::hypot(correction.x_m, correction.y_m);
  if (!std::isfinite(way) || !std::isfinite(correction.yaw_rad))
    return makeError(ErrorCode::InvalidInput, "the correction of {} is not a number",
                     state_.places[index].name);
  if (way > kLargest_m || std::abs(correction.yaw_rad) > kLargest_rad)
    return makeError(ErrorCode::Refused,
                     "{} would be moved by {:.2f} m and {:.0f} deg; at most 1 m and 30 deg at once",
                     state_.places[index].name, way, correction.yaw_rad * 180.0 / M_PI);
  FirePlace& place = state_.places[index];
  place.p_plate_map += Eigen::Vector3d(correction.x_m, correction.y_m, 0.0);
  place.facing_rad = wrapAngle(place.facing_rad + correction.yaw_rad);
  place.estimate.reset();
  place.visited = place.extinguished;
  ++place.nudges;
  place.nudge = {place.nudge.x_m + correction.x_m, place.nudge.y_m + correction.y_m,
                 wrapAngle(place.nudge.yaw_rad + correction.yaw_rad)};
  return {};
}

void WorldModel::startClock(Stamp now) {
  if (state_.clock_started) return;
  state_.clock_started = true;
  state_.clock_start = now;
}

void WorldModel::restore(WorldState saved, Stamp saved_at, Stamp now) {
  state_ = std::move(saved);
  if (state_.clock_started && now < saved_at)
    state_.clock_start = now - (saved_at - state_.clock_start);
  publish();
}

void WorldModel::publish() {
  auto copy = std::make_shared<const WorldState>(state_);
  const std::lock_guard lock(mutex_);
  published_ = std::move(copy);
}

std::shared_ptr<const WorldState> WorldModel::snapshot() const {
  const std::lock_guard lock(mutex_);
  return published_;
}

}  // namespace kiln
