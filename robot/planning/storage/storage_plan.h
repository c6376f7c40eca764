#pragma once

#include <span>
#include <vector>

#include "robot/planning/storage/storage_room.h"

namespace kiln {

/// One brick set in or taken out.
struct StorageStep {
  std::size_t brick = 0;  ///< its place in the build sequence
  Seat seat;
  StoragePosture posture;  ///< of all compartments while the arm is at the seat
};

/// One load: which brick stands where, and in which order it is set in and taken out.
struct StoragePlan {
  std::vector<BrickKind> sequence;  ///< the bricks in the order in which they are built
  std::vector<StorageStep> load;    ///< from the pile: kinds drawn together, stacks from the floor
  std::vector<StorageStep> unload;  ///< at the wall: in the order of the sequence
  int load_stops = 0, unload_stops = 0;  ///< times that the arm waits for compartments to travel
  int mixed_bins = 0;                    ///< with more than one kind: bound to the planned order
};

/// Finds bins for one load so that it is unloaded in the order of building without re-sorting: in
/// each bin lies on top what is needed first. Bins of one kind if they suffice (then another order
/// of kinds can still be served, as the paper's storage can), else as few mixed ones as possible.
/// Bins are then exchanged for few stops of the compartments while unloading; a local search, not
/// proven least.
/// Error: InvalidInput, names the brick that does not fit and why, or what is wrong with the room.
[[nodiscard]] Result<StoragePlan> planStorage(const StorageRoom& room, const StorageConfig& config,
                                              std::span<const BrickKind> sequence);

/// Walks through a plan by itself, apart from the planner: the room is free of collisions; each
/// brick is set in once, upon what stands in its bin, within the stack rule; taken out in the order
/// of the sequence, from the top of its bin; every seat is in reach and its way to the front free
/// while the compartments stand as stated, within their travel; and with everything loaded no brick
/// is inside of anything. To be asked before the first pick.
/// Error: InvalidInput, names step, brick and seat, and what is wrong.
[[nodiscard]] Result<void> checkStoragePlan(const StorageRoom& room, const StorageConfig& config,
                                            const StoragePlan& plan);

}  // namespace kiln
