#include "robot/planning/storage/posture_sets.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kiln {
namespace {

constexpr std::size_t kMostPostures = 20'000;

/// From end to end in even steps, rest position included.
std::vector<double> travelOf(const CompartmentConfig& row, double step_m) {
  std::vector<double> out;
  const auto steps = static_cast<int>(std::ceil((row.travel_max_m - row.travel_min_m) / step_m));
  for (int i = 0; i <= steps; ++i)
    out.push_back(std::min(row.travel_max_m, row.travel_min_m + i * step_m));
  if (std::none_of(out.begin(), out.end(), [](double at) { return std::abs(at) < 1e-9; }))
    out.push_back(0.0);
  return out;
}

void insert(PostureSet& set, std::size_t posture) {
  set[posture / 64] |= std::uint64_t{1} << posture % 64;
}

bool contains(const PostureSet& set, std::size_t posture) {
  return (set[posture / 64] >> posture % 64 & 1U) != 0;
}

}  // namespace

bool intersect(PostureSet& a, const PostureSet& b) {
  std::uint64_t left = 0;
  for (std::size_t i = 0; i < a.size(); ++i) left |= a[i] &= b[i];
  return left != 0;
}

bool isEmpty(const PostureSet& set) {
  return std::all_of(set.begin(), set.end(), [](std::uint64_t word) { return word == 0; });
}

Result<void> PostureGrid::fits(const StorageRoom& room, const StorageConfig& config) {
  std::size_t postures = 1;
  for (const CompartmentConfig& row : room.rows) {
    postures *= travelOf(row, config.travel_step_m).size();
    if (postures > kMostPostures)
      return makeError(ErrorCode::InvalidInput,
                       "storage: more than {} positions of the compartments to look at; make "
                       "travel_step_m larger",
                       kMostPostures);
  }
  return {};
}

PostureGrid::PostureGrid(const StorageRoom& room, const StorageConfig& config)
    : room_(room), config_(config) {
  for (const CompartmentConfig& row : room.rows) {
    stride_.push_back(postures_);
    travel_.push_back(travelOf(row, config.travel_step_m));
    postures_ *= travel_.back().size();
  }
  for (std::size_t c = 0; c < room.rows.size(); ++c) {
    bin_open_.emplace_back();
    for (int bin = 0; bin < room.rows[c].bins; ++bin) {
      PostureSet open = all();
      for (std::size_t other = 0; other < room.rows.size(); ++other) {
        if (other == c) continue;
        // Only the two of them matter: asked once for each pair of their positions.
        std::vector<std::vector<bool>> barred(travel_[c].size());
        for (std::size_t i = 0; i < travel_[c].size(); ++i)
          for (const double other_m : travel_[other])
            barred[i].push_back(bars(room, config, other, other_m, {c, bin, 0.0}, travel_[c][i]));
        for (std::size_t posture = 0; posture < postures_; ++posture)
          if (barred[indexIn(posture, c)][indexIn(posture, other)])
            open[posture / 64] &= ~(std::uint64_t{1} << posture % 64);
      }
      bin_open_.back().push_back(std::move(open));
    }
  }
}

PostureSet PostureGrid::all() const {
  PostureSet set((postures_ + 63) / 64, 0);
  for (std::size_t posture = 0; posture < postures_; ++posture) insert(set, posture);
  return set;
}

PostureSet PostureGrid::serving(const Seat& seat, BrickKind kind) const {
  PostureSet set = bin_open_[seat.compartment][static_cast<std::size_t>(seat.bin)];
  const auto height_mm = static_cast<int>(std::lround(1e3 * seat.height_m));
  std::vector<bool>& near = near_[{seat.compartment, seat.bin, height_mm, kind}];
  if (near.empty())
    for (const double at : travel_[seat.compartment])
      near.push_back(fixedFault(room_, config_, at, seat, kind).empty());
  for (std::size_t posture = 0; posture < postures_; ++posture)
    if (!near[indexIn(posture, seat.compartment)])
      set[posture / 64] &= ~(std::uint64_t{1} << posture % 64);
  return set;
}

StoragePosture PostureGrid::nearest(const PostureSet& set, const StoragePosture& from) const {
  StoragePosture best;
  std::tuple<int, double> least{};
  for (std::size_t posture = 0; posture < postures_; ++posture) {
    if (!contains(set, posture)) continue;
    StoragePosture at;
    std::tuple<int, double> cost{0, 0.0};
    for (std::size_t c = 0; c < travel_.size(); ++c) {
      at.push_back(travel_[c][indexIn(posture, c)]);
      const double way_m = std::abs(at[c] - from[c]);
      std::get<0>(cost) += way_m > 1e-9 ? 1 : 0;
      std::get<1>(cost) += way_m;
    }
    if (!best.empty() && cost >= least) continue;
    best = std::move(at);
    least = cost;
  }
  return best;
}

}  // namespace kiln
