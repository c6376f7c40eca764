#include "robot/world_model/world_model.h"

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
