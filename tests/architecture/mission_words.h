#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln::architecture {

/// words.txt: what only missions may talk about, and who is exempt from which word.
struct WordTable {
  std::set<std::string> words;
  std::map<std::string, std::set<std::string>> exempt;  ///< room -> words that it may use
  /// Error: no `words:`, a line without colon, or an exemption of something that is no such word.
  [[nodiscard]] static Result<WordTable> parse(const std::string& text);
};

/// Identifiers and include paths of one source file with a mission's word in them, as
/// `path:line: what`; "FirePlace", "fire_places", "kFire", "robot/missions/fire/x.h". Comments and
/// other texts may say what they like. Empty for a file outside of the table's rooms.
[[nodiscard]] std::vector<std::string> missionWords(const WordTable& table, const std::string& path,
                                                    const std::string& text);

/// The same for each .h and .cpp of the table's rooms below `root`. An exemption that no file needs
/// is reported too.
[[nodiscard]] std::vector<std::string> missionWordsBelow(const WordTable& table,
                                                         const std::filesystem::path& root);

}  // namespace kiln::architecture
