#include "tests/architecture/mission_words.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <utility>

#include "tests/architecture/include_rules.h"

namespace kiln::architecture {
namespace {

/// Without comment, and without texts but the paths of includes.
std::string codeOf(const std::string& line) {
  static const std::regex kInclude("^\\s*#\\s*include.*"), kText("\"(\\\\.|[^\"\\\\])*\"");
  if (std::regex_match(line, kInclude)) return line;
  const std::string code = std::regex_replace(line, kText, "\"\"");
  return code.substr(0, code.find("//"));
}

/// "FirePlaces" -> fire, place: the parts of an identifier, singular, in small letters.
std::vector<std::string> partsOf(const std::string& identifier) {
  static const std::regex kPart("[A-Z]+(?![a-z])|[A-Z]?[a-z]+");
  std::vector<std::string> out;
  for (auto it = std::sregex_iterator(identifier.begin(), identifier.end(), kPart);
       it != std::sregex_iterator(); ++it) {
    std::string part = it->str();
    std::transform(part.begin(), part.end(), part.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    out.push_back(part);
  }
  return out;
}

/// The word of which a part is a form: "spraying" of "spray", "litres" of "litre"; empty: of none.
std::string wordIn(const std::set<std::string>& words, const std::string& part) {
  for (const char* ending : {"", "s", "ing", "ed"}) {
    const std::string end = ending;
    if (!part.ends_with(end)) continue;
    const std::string stem = part.substr(0, part.size() - end.size());
    if (words.contains(stem)) return stem;
  }
  return {};
}

/// The innermost one.
std::string roomOf(const WordTable& table, const std::string& path) {
  std::string found;
  for (const auto& [room, words] : table.exempt)
    if (path.starts_with(room + "/") && room.size() > found.size()) found = room;
  return found;
}

struct Found {
  int line = 0;
  std::string identifier, word;
};

std::vector<Found> find(const WordTable& table, const std::string& text) {
  static const std::regex kIdentifier("[A-Za-z_][A-Za-z0-9_]*");
  std::vector<Found> out;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string code = codeOf(line);
    for (auto it = std::sregex_iterator(code.begin(), code.end(), kIdentifier);
         it != std::sregex_iterator(); ++it) {
      for (const std::string& part : partsOf(it->str()))
        if (const std::string word = wordIn(table.words, part); !word.empty())
          out.push_back({number, it->str(), word});
    }
  }
  return out;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

Result<WordTable> WordTable::parse(const std::string& text) {
  auto rows = parseTable(text, "words.txt");
  if (!rows) return tl::make_unexpected(rows.error());
  WordTable table;
  table.words = std::exchange((*rows)["words"], {});
  rows->erase("words");
  table.exempt = std::move(*rows);
  if (table.words.empty()) return makeError(ErrorCode::InvalidInput, "words.txt: no 'words:'");
  for (const auto& [room, words] : table.exempt)
    for (const std::string& word : words)
      if (!table.words.contains(word))
        return makeError(ErrorCode::InvalidInput, "words.txt: '{}' of {} is no word of a mission",
                         word, room);
  return table;
}

std::vector<std::string> missionWords(const WordTable& table, const std::string& path,
                                      const std::string& text) {
  const std::string room = roomOf(table, path);
  std::vector<std::string> out;
  if (room.empty()) return out;
  for (const Found& found : find(table, text))
    if (!table.exempt.at(room).contains(found.word))
      out.push_back(path + ":" + std::to_string(found.line) + ": '" + found.identifier +
                    "' knows a mission (" + found.word + ")");
  return out;
}

std::vector<std::string> missionWordsBelow(const WordTable& table,
                                           const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<std::string> out;
  for (const auto& [room, words] : table.exempt) {
    std::set<std::string> unused = words;
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string text = read(entry.path());
      const std::string path = fs::relative(entry.path(), root).generic_string();
      for (std::string& found : missionWords(table, path, text)) out.push_back(std::move(found));
      for (const Found& found : find(table, text)) unused.erase(found.word);
    }
    for (const std::string& word : unused)
      out.push_back("words.txt: " + room + " does not need '" + word + "' any more; take it out");
  }
  return out;
}

}  // namespace kiln::architecture
