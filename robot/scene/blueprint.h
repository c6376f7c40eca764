#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/error.h"
#include "robot/scene/wall_layout.h"

namespace kiln {

/// How the lines of a file are to be read.
struct BlueprintView {
  bool mirrored = false;      ///< each line from right to left: drawn as seen from the other side
  bool bottom_first = false;  ///< the first line is the layer at the ground (a variant in use)
};

inline constexpr std::size_t kMostBlueprintBytes = 4096;

/// Reads the official text format (hardware.md section 8): a line a layer, the top layer first,
/// letters R, G, B separated by one space; lines end in CR LF or LF, the last one in either or
/// nothing. Which wall it is tells the number of letters:
/// - 23 or more: the official wall, five lines of seven, each 4 R, 2 G and 1 B; the orange leg (two
///   a layer) is implied;
/// - fewer: the wall of the lab task, one to five lines with 4 R, 4 G and 3 B in all; no layer may
///   be longer than the one below, so that each brick lies on two or more or on the ground; no
///   orange leg.
/// Layers begin at the same left edge; lengths are compared without joints (multiples of 0.3 m).
/// @param file  named in errors
/// Error: InvalidInput, `file:line:column: what is wrong; what would be right`.
[[nodiscard]] Result<Blueprint> parseBlueprint(std::string_view text, const std::string& file,
                                               BlueprintView view = {});
/// parseBlueprint() of a regular file of at most kMostBlueprintBytes; errors of readRegularFile().
[[nodiscard]] Result<Blueprint> loadBlueprint(const std::string& path, BlueprintView view = {});

/// In the official format, with CR LF after each line; parseBlueprint() gives it back.
[[nodiscard]] std::string formatBlueprint(const Blueprint& blueprint);
/// formatBlueprint() into a file. Error: as writeFileAtomically().
[[nodiscard]] Result<void> saveBlueprint(const Blueprint& blueprint, const std::string& path);

/// An official wall; each layer in an order of its own, all orders alike. The same seed gives the
/// same wall on every machine.
[[nodiscard]] Blueprint randomBlueprint(std::uint64_t seed);

/// "blue, layer 2, 4th from the left": a slot in words, counted from 1.
[[nodiscard]] std::string describeSlot(const WallSlot& slot);

}  // namespace kiln
