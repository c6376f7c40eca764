#include <algorithm>
#include <cmath>
#include <map>

#include "robot/planning/storage/storage_plan.h"

namespace kiln {
namespace {

constexpr double kSame_m = 1e-6;
constexpr double kDeepest_m = 1e-3;  // bricks rest on floors and backs; more is an overlap

/// What stands where, brick by brick.
class Stored {
 public:
  Stored(const StorageRoom& room, const StorageConfig& config, const StoragePlan& plan)
      : room_(room), config_(config), plan_(plan) {}

  /// @return empty, or what is wrong.
  std::string setIn(const StorageStep& step) {
    if (const std::string fault = faultOf(step); !fault.empty()) return fault;
    if (seat_of_.contains(step.brick)) return "is set in twice";
    auto& stack = bins_[{step.seat.compartment, step.seat.bin}];
    std::vector<BrickKind> kinds = kindsOf(stack);
    if (std::abs(heightOf(kinds) - step.seat.height_m) > kSame_m)
      return fmt::format("should stand {:.2f} m high, its bin is filled up to {:.2f} m",
                         step.seat.height_m, heightOf(kinds));
    kinds.push_back(plan_.sequence[step.brick]);
    if (std::string fault = stackFault(room_, config_, step.seat.compartment, kinds);
        !fault.empty())
      return fault;
    stack.push_back(step.brick);
    seat_of_[step.brick] = step.seat;
    return {};
  }
  std::string takeOut(const StorageStep& step) {
    if (const std::string fault = faultOf(step); !fault.empty()) return fault;
    auto& stack = bins_[{step.seat.compartment, step.seat.bin}];
    if (stack.empty() || std::find(stack.begin(), stack.end(), step.brick) == stack.end())
      return "is not there";
    if (stack.back() != step.brick)
      return fmt::format("is under brick {}; what is needed first must lie on top",
                         stack.back() + 1);
    if (std::abs(seat_of_.at(step.brick).height_m - step.seat.height_m) > kSame_m)
      return "stands at another height";
    stack.pop_back();
    return {};
  }
  /// Every stored brick against everything else.
  [[nodiscard]] Result<void> checkOverlaps(const StoragePosture& posture) const {
    std::vector<StoredBrick> stored;
    for (const auto& [brick, seat] : seat_of_) stored.push_back({plan_.sequence[brick], seat});
    const auto boxes = storageBoxes(room_, posture, stored);
    const std::size_t walls = boxes.size() - stored.size();
    for (std::size_t i = walls; i < boxes.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (boxes[i].bounds.intersects(boxes[k].bounds) &&
            distance(boxes[i], boxes[k]) < -kDeepest_m)
          return makeError(ErrorCode::InvalidInput, "storage: {} is inside of {}", boxes[i].name,
                           boxes[k].name);
    return {};
  }

 private:
  using Bin = std::pair<std::size_t, int>;

  [[nodiscard]] std::string faultOf(const StorageStep& step) const {
    if (step.brick >= plan_.sequence.size()) return "is none of the build order";
    if (step.seat.compartment >= room_.rows.size() || step.seat.bin < 0 ||
        step.seat.bin >= room_.rows[step.seat.compartment].bins)
      return "has a seat that is not there";
    if (step.posture.size() != room_.rows.size()) return "lacks the position of a compartment";
    for (std::size_t i = 0; i < room_.rows.size(); ++i)
      if (!(step.posture[i] >= room_.rows[i].travel_min_m - kSame_m &&
            step.posture[i] <= room_.rows[i].travel_max_m + kSame_m))
        return fmt::format("wants {} at {:.2f} m, beyond its travel", room_.rows[i].name,
                           step.posture[i]);
    return accessFault(room_, config_, step.posture, step.seat, plan_.sequence[step.brick]);
  }
  [[nodiscard]] std::vector<BrickKind> kindsOf(const std::vector<std::size_t>& stack) const {
    std::vector<BrickKind> kinds;
    for (const std::size_t brick : stack) kinds.push_back(plan_.sequence[brick]);
    return kinds;
  }
  [[nodiscard]] static double heightOf(const std::vector<BrickKind>& kinds) {
    double height_m = 0.0;
    for (const BrickKind kind : kinds) height_m += brickShape(kind).length_m;
    return height_m;
  }

  const StorageRoom& room_;
  const StorageConfig& config_;
  const StoragePlan& plan_;
  std::map<Bin, std::vector<std::size_t>> bins_;
  std::map<std::size_t, Seat> seat_of_;
};

tl::unexpected<Error> refuse(const StorageRoom& room, const StoragePlan& plan, const char* act,
                             std::size_t number, const StorageStep& step,
                             const std::string& fault) {
  const bool known = step.brick < plan.sequence.size();
  const bool there = step.seat.compartment < room.rows.size();
  return makeError(ErrorCode::InvalidInput, "storage: {} step {}: brick {} ({}) in {}: {}", act,
                   number + 1, step.brick + 1,
                   known ? brickShape(plan.sequence[step.brick]).name : "unknown",
                   there ? describe(room, step.seat) : "no compartment", fault);
}

}  // namespace

Result<void> checkStoragePlan(const StorageRoom& room, const StorageConfig& config,
                              const StoragePlan& plan) {
  if (auto checked = checkRoom(room, config); !checked) return checked;
  const std::size_t bricks = plan.sequence.size();
  if (plan.load.size() != bricks || plan.unload.size() != bricks)
    return makeError(ErrorCode::InvalidInput,
                     "storage: the plan loads {} and unloads {} of {} bricks", plan.load.size(),
                     plan.unload.size(), bricks);
  Stored stored(room, config, plan);
  for (std::size_t i = 0; i < bricks; ++i)
    if (const std::string fault = stored.setIn(plan.load[i]); !fault.empty())
      return refuse(room, plan, "load", i, plan.load[i], fault);
  if (bricks > 0)
    if (auto checked = stored.checkOverlaps(plan.load.back().posture); !checked) return checked;
  for (std::size_t i = 0; i < bricks; ++i) {
    if (plan.unload[i].brick != i)
      return refuse(room, plan, "unload", i, plan.unload[i],
                    fmt::format("the build order wants brick {} now", i + 1));
    if (const std::string fault = stored.takeOut(plan.unload[i]); !fault.empty())
      return refuse(room, plan, "unload", i, plan.unload[i], fault);
  }
  return {};
}

}  // namespace kiln
