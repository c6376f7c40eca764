#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/paths.h"

namespace kiln::testing {

/// A file of the real sensor captures, which are not part of the project: below $KILN_DATA_DIR,
/// else below
/// ../shared/data beside the source tree. nullopt when it is not there; the test then skips and
/// names it:
///   const auto file = dataFile("ur_packets/primary_robot_state.bin");
///   if (!file) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
[[nodiscard]] inline std::optional<std::filesystem::path> dataFile(const std::string& relative) {
  const char* set = std::getenv("KILN_DATA_DIR");
  const std::filesystem::path root =
      set != nullptr && *set != '\0' ? set
                                     : std::filesystem::path(kiln::sourceDir()) / "../shared/data";
  std::error_code ec;
  const std::filesystem::path path = root / relative;
  if (!std::filesystem::exists(path, ec)) return std::nullopt;
  return path;
}

}  // namespace kiln::testing
