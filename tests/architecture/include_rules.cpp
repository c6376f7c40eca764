#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <sstream>

namespace kiln::architecture {
namespace {

bool startsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

bool isHeader(const std::string& path) {
  return path.size() > 2 && path.substr(path.size() - 2) == ".h";
}

/// Seconds of compile time each: only a .cpp may show them.
bool isHeavy(const std::string& include) {
  static const std::array<const char*, 9> kHeavy{"pcl/",    "ceres/",   "vtk", "QVTK",     "embree",
                                                 "mujoco/", "opencv2/", "zmq", "yaml-cpp/"};
  return std::any_of(kHeavy.begin(), kHeavy.end(),
                     [&](const char* prefix) { return startsWith(include, prefix); });
}

bool isQt(const std::string& include) {
  static const std::regex kQt("Q[A-Z].*|Qt[A-Z]?.*/.*");
  return std::regex_match(include, kQt);
}

bool mayReadTheClock(const std::string& path) {
  return path == "common/core/clock.cpp" || startsWith(path, "common/transport/");
}

bool readsTheClock(const std::string& line) {
  static const std::regex kNow("::now\\s*\\(\\s*\\)(?!\\s*(const|override))");
  return std::regex_search(line, kNow);
}

std::string withoutComment(const std::string& line) { return line.substr(0, line.find("//")); }

/// What is wrong with one include, or empty.
std::string judge(const RoomTable& table, const std::string& path, const std::string& include,
                  bool quoted) {
  if (isHeader(path) && isHeavy(include))
    return "heavy header in a public header; include it in the .cpp";
  if (!startsWith(path, "gui/") && isQt(include)) return "Qt outside gui/";
  const std::string from = table.roomOf(path);
  if (startsWith(include, "tests/")) return "the program may not include its tests";
  std::string to = table.roomOf(include);
  if (startsWith(include, "kiln/v1/") || startsWith(include, "foxglove/")) to = "proto";
  if (to.empty()) {
    const bool ours = startsWith(include, "common/") || startsWith(include, "robot/") ||
                      startsWith(include, "gui/");
    if (ours)
      return include.substr(0, include.rfind('/')) +
             " is in no room of tests/architecture/rooms.txt";
    const bool from_root = !quoted || include.find('/') != std::string::npos;
    return from_root ? "" : "include path must start at the root";
  }
  if (to == from || table.allowed.at(from).count(to) > 0) return "";
  return from + " may not include " + to;
}

}  // namespace

Result<std::map<std::string, std::set<std::string>>> parseTable(const std::string& text,
                                                                const std::string& file) {
  std::map<std::string, std::set<std::string>> table;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos)
      return makeError(ErrorCode::InvalidInput, "{}:{}: no colon", file, number);
    std::istringstream words(line.substr(colon + 1));
    auto& row = table[line.substr(0, colon)];
    for (std::string word; words >> word;) row.insert(word);
  }
  return table;
}

Result<RoomTable> RoomTable::parse(const std::string& text) {
  auto rows = parseTable(text, "rooms.txt");
  if (!rows) return tl::make_unexpected(rows.error());
  RoomTable table{std::move(*rows)};
  bool grew = true;
  while (grew) {
    grew = false;
    for (auto& [room, allowed] : table.allowed) {
      const std::set<std::string> before = allowed;
      for (const std::string& through : before) {
        const auto further = table.allowed.find(through);
        if (further == table.allowed.end()) {
          return makeError(ErrorCode::InvalidInput, "rooms.txt: '{}' allows '{}', which is no room",
                           room, through);
        }
        allowed.insert(further->second.begin(), further->second.end());
      }
      if (allowed.count(room) > 0) {
        return makeError(ErrorCode::InvalidInput, "rooms.txt: '{}' may include itself in a circle",
                         room);
      }
      grew = grew || allowed.size() > before.size();
    }
  }
  return table;
}

std::string RoomTable::roomOf(const std::string& path) const {
  for (std::string folder = path; folder.find('/') != std::string::npos;) {
    folder = folder.substr(0, folder.rfind('/'));
    if (allowed.count(folder) > 0) return folder;
  }
  return "";
}

std::vector<std::string> violations(const RoomTable& table, const std::string& path,
                                    const std::string& text) {
  static const std::regex kInclude("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  std::vector<std::string> out;
  const auto report = [&](int number, const std::string& what, const std::string& line) {
    out.push_back(path + ":" + std::to_string(number) + ": " + what + ": " + line);
  };
  if (table.roomOf(path).empty()) {
    report(1, "this folder is in no room of tests/architecture/rooms.txt", path);
    return out;
  }
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) {
      const std::string what = judge(table, path, match[2].str(), match[1].str() == "\"");
      if (!what.empty()) report(number, what, line);
    } else if (!mayReadTheClock(path) && readsTheClock(withoutComment(line))) {
      report(number, "reads the machine's clock; take a Clock& instead", line);
    }
  }
  return out;
}

std::vector<std::string> violationsBelow(const RoomTable& table,
                                         const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<std::string> paths;
  for (const char* top : {"common", "robot", "gui"}) {
    if (!fs::is_directory(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const fs::path extension = entry.path().extension();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cpp")) {
        paths.push_back(fs::relative(entry.path(), root).generic_string());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> out;
  for (const std::string& path : paths) {
    std::ifstream in(root / path);
    std::ostringstream text;
    text << in.rdbuf();
    for (std::string& violation : violations(table, path, text.str()))
      out.push_back(std::move(violation));
  }
  return out;
}

}  // namespace kiln::architecture
