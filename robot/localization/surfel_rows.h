#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "robot/localization/byte_columns.h"
#include "robot/localization/surfel_map.h"

namespace kiln {

/// One side of one cell of a surfel map in the numbers that a map file stores: mean in 1/255 of a
/// cell, covariance in 1e-4 of a cell squared ((1 mm)^2 at 0.1 m), view direction in 1/127.
struct SurfelRow {
  SurfelMap::Cell cell;
  int side = 0;
  std::uint64_t count = 0;
  std::array<std::uint8_t, 3> mean{};
  std::array<std::int64_t, 6> covariance{};  ///< xx yy zz xy xz yz
  std::array<std::int8_t, 3> view{};

  [[nodiscard]] SurfelMoments moments(double cell_m) const;
};

/// The cells of one level with at least `min_points`, ordered by z, y, x and side.
[[nodiscard]] std::vector<SurfelRow> surfelRows(const SurfelMap& map, int level, int min_points);

/// Column by column, cells as differences: what compresses well.
void writeSurfelRows(const std::vector<SurfelRow>& rows, ByteWriter& out);
/// @return false if the bytes end early or a value is out of range.
[[nodiscard]] bool readSurfelRows(ByteReader& in, std::vector<SurfelRow>& rows);

}  // namespace kiln
