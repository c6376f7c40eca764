#include "robot/scene/pile_layout.h"

#include <algorithm>
#include <array>

#include "common/core/check.h"

namespace kiln {

std::vector<PileStack> arenaPile() {
  using enum BrickKind;
  return {{Red}, {Red}, {Red}, {Red}, {Green}, {Green}, {Blue}, {Orange, 2}, {Orange, 2}};
}

std::vector<PileStack> labPile() {
  using enum BrickKind;
  return {{Red, 1, 4}, {Green, 1, 4}, {Blue, 1, 3}};
}

std::vector<PileSlot> pileSlots(std::span<const PileStack> stacks) {
  std::vector<PileSlot> slots;
  std::array<double, 2> at{};  // where each line's next stack begins
  for (std::size_t s = 0; s < stacks.size(); ++s) {
    const PileStack& stack = stacks[s];
    KILN_CHECK((stack.line == 1 || stack.line == 2) && stack.bricks > 0, stack.line, stack.bricks);
    const auto line = static_cast<std::size_t>(stack.line - 1);
    const double length = brickShape(stack.kind).length_m;
    for (std::size_t layer = 0; layer < static_cast<std::size_t>(stack.bricks); ++layer) {
      PileSlot slot{stack.kind, s, layer, Eigen::Isometry3d::Identity()};
      slot.X_pile_brick.translation() =
          Eigen::Vector3d(at[line] + length / 2.0, static_cast<double>(line) * kPileLineDistance_m,
                          (static_cast<double>(layer) + 0.5) * kBrickSide_m);
      slots.push_back(slot);
    }
    at[line] += length + kPileGap_m;
  }
  return slots;
}

double pileLength(std::span<const PileStack> stacks) {
  std::array<double, 2> length{};
  for (const PileStack& stack : stacks)
    length[static_cast<std::size_t>(stack.line - 1)] +=
        brickShape(stack.kind).length_m + kPileGap_m;
  return std::max(0.0, std::max(length[0], length[1]) - kPileGap_m);
}

}  // namespace kiln
