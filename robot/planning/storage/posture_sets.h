#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "robot/planning/storage/storage_room.h"

namespace kiln {

/// A set of postures of the compartments, a bit each.
using PostureSet = std::vector<std::uint64_t>;
/// a &= b. @return false: nothing is left.
bool intersect(PostureSet& a, const PostureSet& b);
[[nodiscard]] bool isEmpty(const PostureSet& set);

/// All postures on a grid over the travel of each compartment, and from which of them a seat can be
/// served. Confined to one thread.
class PostureGrid {
 public:
  /// @pre config is valid, at most some 20,000 postures (see fits()).
  PostureGrid(const StorageRoom& room, const StorageConfig& config);
  [[nodiscard]] static Result<void> fits(const StorageRoom& room, const StorageConfig& config);

  [[nodiscard]] PostureSet serving(const Seat& seat, BrickKind kind) const;
  [[nodiscard]] PostureSet all() const;
  /// The member that moves the fewest compartments, those the least. @pre not empty.
  [[nodiscard]] StoragePosture nearest(const PostureSet& set, const StoragePosture& from) const;

 private:
  [[nodiscard]] std::size_t indexIn(std::size_t posture, std::size_t compartment) const {
    return posture / stride_[compartment] % travel_[compartment].size();
  }

  const StorageRoom& room_;
  const StorageConfig& config_;
  std::vector<std::vector<double>> travel_;  ///< of each compartment
  std::vector<std::size_t> stride_;
  std::size_t postures_ = 1;
  /// bin_open_[compartment][bin]: postures in which nothing stands before the bin.
  std::vector<std::vector<PostureSet>> bin_open_;
  /// From which positions of its compartment the arm serves a seat; asked once for each.
  mutable std::map<std::tuple<std::size_t, int, int, BrickKind>, std::vector<bool>> near_;
};

}  // namespace kiln
