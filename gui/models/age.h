#pragma once

#include <cstdint>

namespace kiln::gui {

/// How old data looks: Fresh plain, Amber with a mark, Red hatched out.
enum class AgeLevel : std::uint8_t { None, Fresh, Amber, Red };

/// When data of one kind looks old. The default is for the status.
struct AgeLimits {
  double amber_s = 1.5;
  double red_s = 3.0;
};
/// Pictures and clouds that a driver steers by.
inline constexpr AgeLimits kVideoAge{0.5, 2.0};
/// Data that changes seldom (graph, map, macros, log).
inline constexpr AgeLimits kSlowAge{5.0, 10.0};

/// @param age_s < 0 means that there was never any data.
[[nodiscard]] constexpr AgeLevel judgeAge(double age_s, const AgeLimits& limits) {
  if (age_s < 0) return AgeLevel::None;
  if (age_s >= limits.red_s) return AgeLevel::Red;
  return age_s >= limits.amber_s ? AgeLevel::Amber : AgeLevel::Fresh;
}

}  // namespace kiln::gui
