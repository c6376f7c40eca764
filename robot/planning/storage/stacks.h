#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "robot/scene/brick.h"

namespace kiln {

/// Bricks of one bin by their place in the build sequence, from the floor up: the last one built
/// lies lowest.
using Stack = std::vector<std::size_t>;

/// Empty, or why these bricks, from the floor up, may not stand in one bin.
using StackRule = std::function<std::string(std::span<const BrickKind>)>;

/// Divides a build sequence into at most `bins` stacks. Of one kind each if that is possible, else
/// with as few mixed ones as possible (searched completely for up to some 15 bricks, then given up).
/// @return nullopt: no division was found.
[[nodiscard]] std::optional<std::vector<Stack>> divideIntoStacks(
    std::span<const BrickKind> sequence, std::size_t bins, const StackRule& rule);

/// Stacks with more than one kind.
[[nodiscard]] int mixedStacks(std::span<const BrickKind> sequence,
                              const std::vector<Stack>& stacks);

}  // namespace kiln
