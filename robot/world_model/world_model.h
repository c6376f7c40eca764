#pragma once

#include <memory>
#include <mutex>

#include "robot/world_model/world_state.h"

namespace kiln {

/// The robot's belief. The mission thread is its sole writer and works on it through edit() and
/// state(); every other thread sees the immutable snapshot of the last publish().
class WorldModel {
 public:
  explicit WorldModel(WorldState initial);

  [[nodiscard]] const WorldState& state() const { return state_; }  ///< mission thread only
  [[nodiscard]] WorldState& edit() { return state_; }               ///< mission thread only
  /// nullptr when no place is selected. Mission thread only.
  [[nodiscard]] FirePlace* currentPlace();
  [[nodiscard]] const FirePlace* currentPlace() const;

  void startClock(Stamp now);
  /// Takes over a checkpointed state. When robot time runs on the same clock as at `saved_at`, the
  /// downtime counts; when it began anew (now < saved_at, the computer was restarted) the mission
  /// clock goes on from where it stood.
  void restore(WorldState saved, Stamp saved_at, Stamp now);

  void publish();
  [[nodiscard]] std::shared_ptr<const WorldState> snapshot() const;  ///< thread-safe, never null

 private:
  WorldState state_;
  mutable std::mutex mutex_;
  std::shared_ptr<const WorldState> published_;
};

}  // namespace kiln
