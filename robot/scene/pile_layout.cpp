#include "robot/scene/pile_layout.h"

#include <algorithm>
#include <array>

#include "common/core/check.h"

namespace kiln {

std::vector<Eigen::Vector2d> PileLayout::middles() const {
  std::vector<Eigen::Vector2d> out;
  std::array<double, 2> at{};  // where each line's next stack begins
  for (const PileStack& stack : stacks) {
    KILN_CHECK((stack.line == 1 || stack.line == 2) && stack.bricks > 0, stack.line, stack.bricks);
    const auto line = static_cast<std::size_t>(stack.line - 1);
    out.emplace_back(at[line] + stack.length() / 2.0, static_cast<double>(line) * line_distance_m);
    at[line] += stack.length() + gap_m;
  }
  return out;
}

std::vector<PileSlot> PileLayout::slots() const {
  std::vector<PileSlot> out;
  const std::vector<Eigen::Vector2d> middle = middles();
  for (std::size_t s = 0; s < stacks.size(); ++s)
    for (std::size_t layer = 0; layer < static_cast<std::size_t>(stacks[s].bricks); ++layer) {
      PileSlot slot{stacks[s].kind, s, layer, Eigen::Isometry3d::Identity()};
      slot.X_pile_brick.translation() << middle[s],
          (static_cast<double>(layer) + 0.5) * kBrickSide_m;
      out.push_back(slot);
    }
  return out;
}

double PileLayout::lineLength(int line) const {
  double length = -gap_m;
  for (const PileStack& stack : stacks)
    if (stack.line == line) length += stack.length() + gap_m;
  return std::max(0.0, length);
}

double PileLayout::length() const { return std::max(lineLength(1), lineLength(2)); }

PileLayout arenaPile() {
  using enum BrickKind;
  return {{{Red}, {Red}, {Red}, {Red}, {Green}, {Green}, {Blue}, {Orange, 2}, {Orange, 2}}};
}

PileLayout labPile() {
  using enum BrickKind;
  return {{{Red, 1, 4}, {Green, 1, 4}, {Blue, 1, 3}}};
}

}  // namespace kiln
