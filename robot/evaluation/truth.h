#pragma once

#include <nlohmann/json.hpp>

namespace kiln {

/// Litres that went through the opening of the place that burns, by the world's own count.
/// @param truth  kiln-sim's report.
[[nodiscard]] inline double burningLitres(const nlohmann::json& truth) {
  for (const auto& place : truth.at("fire_places")) {
    if (place.at("burning").get<bool>()) return place.at("litres").get<double>();
  }
  return 0.0;
}

}  // namespace kiln
