#pragma once

#include <memory>
#include <mutex>

#include "common/core/error.h"
#include "common/core/mutex.h"
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

  /// The operator's correction of where a place stands: shifted by (x, y) in map and turned by yaw
  /// about its plate. What was seen of its fire before is forgotten, and it may be visited anew.
  /// Error: Refused for more than 1 m or 30 deg at once (a mistake, not a nudge), InvalidInput for
  /// an unknown place or a correction that is not finite.
  [[nodiscard]] Result<void> nudgePlace(std::size_t index, const Pose2& correction);

  void startClock(Stamp now);
  /// Takes over a checkpointed state. When robot time runs on the same clock as at `saved_at`, the
  /// downtime counts; when it began anew (now < saved_at, the computer was restarted) the mission
  /// clock goes on from where it stood.
  void restore(WorldState saved, Stamp saved_at, Stamp now);

  void publish();
  [[nodiscard]] std::shared_ptr<const WorldState> snapshot() const;  ///< thread-safe, never null

 private:
  WorldState state_;
  mutable Mutex mutex_;
  std::shared_ptr<const WorldState> published_;
};

}  // namespace kiln
