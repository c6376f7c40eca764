#pragma once

#include <cstdint>
#include <string_view>

namespace kiln::sim {

/// Seeded random numbers (xoshiro256**), one stream a purpose, so that switching one sensor off
/// does not change the noise of another. Same seed, same build: the same numbers.
/// Thread-compatible.
class Random {
 public:
  Random(std::uint64_t seed, std::string_view purpose);
  [[nodiscard]] std::uint64_t bits();
  [[nodiscard]] double uniform();  ///< [0, 1)
  [[nodiscard]] double uniform(double min, double max) { return min + (max - min) * uniform(); }
  /// Standard normal from a table of 16384 quantiles (cut at 4 sigma): 2 ns, for 300,000 LiDAR
  /// points a second.
  [[nodiscard]] float normal();
  [[nodiscard]] double normal(double sigma) { return sigma * static_cast<double>(normal()); }

 private:
  std::uint64_t s_[4];
};

}  // namespace kiln::sim
