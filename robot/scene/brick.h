#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace kiln {

/// Kinds of bricks of Challenge 2, told apart by their colour.
enum class BrickKind : std::uint8_t { Red, Green, Blue, Orange };

inline constexpr std::size_t kBrickKinds = 4;

/// Nominal data of one kind; the bricks of a world differ by up to 2 mm (scenario.md section 1).
struct BrickShape {
  BrickKind kind = BrickKind::Red;
  std::string_view name;
  char letter = '?';                                  ///< in a blueprint
  double length_m = 0.0;                              ///< along the brick's X
  double mass_kg = 0.0;                               ///< [P]
  double plate_length_m = 0.0, plate_width_m = 0.15;  ///< one ferromagnetic plate on the upper side
  int plates = 1;                                     ///< side by side along X
  int points = 0;                                     ///< for one placed [E]
  int count = 0;                                      ///< in the task of 45
};

/// Cross-section, along the brick's Y and Z. The frame of a brick: its centre, X along its length,
/// Z up, the plate at +Z.
inline constexpr double kBrickSide_m = 0.2;

/// Paper, section "MBZIRC 2020"; plates: scenario.md section 4.
inline constexpr std::array<BrickShape, kBrickKinds> kBrickShapes{{
    {BrickKind::Red, "red", 'R', 0.3, 1.0, 0.20, 0.15, 1, 1, 20},
    {BrickKind::Green, "green", 'G', 0.6, 1.5, 0.30, 0.15, 1, 2, 10},
    {BrickKind::Blue, "blue", 'B', 1.2, 1.5, 0.30, 0.15, 1, 3, 5},
    {BrickKind::Orange, "orange", 'O', 1.8, 2.0, 0.19, 0.15, 3, 4, 10},
}};

[[nodiscard]] constexpr const BrickShape& brickShape(BrickKind kind) {
  return kBrickShapes[static_cast<std::size_t>(kind)];
}

}  // namespace kiln
