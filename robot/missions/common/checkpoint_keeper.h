#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "robot/missions/common/mission_checkpoint.h"
#include "robot/world_model/checkpoint_writer.h"

namespace kiln {

/// Writes one mission's checkpoint: after each transition, when what holds the mission changes, and
/// in between so often that little is lost by a kill. Confined to the mission thread; the disk is
/// written by a thread of its own.
class CheckpointKeeper {
 public:
  struct Config {
    std::string path{};     ///< empty: nothing is kept
    double period_s = 0.2;  ///< between actions; the last pose is at most this old after a kill
    /// Empty: a CheckpointWriter of `path`.
    std::function<void(std::string text, bool durable)> write{};
  };
  /// @param take  the checkpoint of now, without its stamp.
  CheckpointKeeper(Config config, std::function<MissionCheckpoint()> take);

  void onTransition(Stamp now) { save(now, true); }
  /// Once a tick while the mission runs.
  void tick(const std::vector<MissionHold>& holds, Stamp now);
  /// Why the newest checkpoint is not on the disk; a full disk costs the resume, not the mission.
  [[nodiscard]] std::optional<Error> problem() const;
  /// Waits until the newest checkpoint was tried.
  void flush();

 private:
  void save(Stamp now, bool durable);

  Config config_;
  std::function<MissionCheckpoint()> take_;
  std::unique_ptr<CheckpointWriter> writer_;
  std::vector<MissionHold> saved_holds_;
  Stamp last_save_;
};

}  // namespace kiln
