#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kiln::test {

/// The value below which this share of them lies. @pre not empty, 0 <= share <= 1
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

}  // namespace kiln::test
