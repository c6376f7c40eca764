#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln::architecture {

/// "name: a b" lines; `#` starts a comment. Error: a line without colon, named by `file` and
/// number.
[[nodiscard]] Result<std::map<std::string, std::set<std::string>>> parseTable(
    const std::string& text, const std::string& file);

/// The table of rooms, closed over what each allowed room may include itself.
struct RoomTable {
  std::map<std::string, std::set<std::string>> allowed;
  /// "room: a b" lines; `#` starts a comment. Error: a line without colon, or a room that is not in
  /// the table.
  [[nodiscard]] static Result<RoomTable> parse(const std::string& text);
  /// The room of a path from the root ("robot/drivers/velodyne/x.h" -> "robot/drivers"), empty if
  /// there is none.
  [[nodiscard]] std::string roomOf(const std::string& path) const;
};

/// Everything that one source file does against the house rules, as `path:line: what`.
[[nodiscard]] std::vector<std::string> violations(const RoomTable& table, const std::string& path,
                                                  const std::string& text);

/// The same for each .h and .cpp below common/, robot/ and gui/ of `root`, in the order of paths.
[[nodiscard]] std::vector<std::string> violationsBelow(const RoomTable& table,
                                                       const std::filesystem::path& root);

}  // namespace kiln::architecture
