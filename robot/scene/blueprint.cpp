#include "robot/scene/blueprint.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#include "common/core/atomic_file.h"
#include "common/core/regular_file.h"
#include "common/core/text.h"

namespace kiln {
namespace {

using Counts = std::array<int, kBrickKinds>;
constexpr Counts kOfficialLayer{4, 2, 1, 0}, kLabWall{4, 4, 3, 0};  // R, G, B, O
constexpr std::size_t kOfficialBricks = 7;
constexpr std::size_t kFewestOfficial = 23;  // midway between 11 and 35
constexpr double kModule_m = 0.3;            // all lengths are multiples of it

/// Lines and columns count from 1.
tl::unexpected<Error> refuse(const std::string& file, std::size_t line, std::size_t column,
                             const std::string& what) {
  return makeError(ErrorCode::InvalidInput, "{}:{}:{}: {}", printable(file), line, column, what);
}

std::optional<BrickKind> kindOf(char letter) {
  for (const BrickShape& shape : kBrickShapes)
    if (shape.letter == letter && shape.kind != BrickKind::Orange) return shape.kind;
  return std::nullopt;
}

/// Where letter `index` of a line stands.
std::size_t columnOf(std::size_t index) { return 2 * index + 1; }

std::string nameOf(char c) {
  if (c == '\t') return "a tab";
  if (c == '\r') return "a carriage return";
  if (c == ' ') return "a space";
  if (c > ' ' && c < 127) return fmt::format("'{}'", c);
  return fmt::format("byte 0x{:02X}", static_cast<unsigned char>(c));
}

std::string whyNoLetter(char c) {
  if (c == 'O') return "'O': the orange leg is implied; only R, G and B stand in the file";
  if (c == ' ') return "a space too many; letters are separated by exactly one";
  if (c == 'r' || c == 'g' || c == 'b')
    return fmt::format("{} is a small letter; write R, G or B", nameOf(c));
  return nameOf(c) + " stands where a letter R, G or B is expected";
}

using Row = std::vector<BrickKind>;

Result<Row> parseLine(std::string_view line, const std::string& file, std::size_t number) {
  if (line.empty())
    return refuse(file, number, 1, "an empty line; each line is a layer of letters R, G and B");
  Row row;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i % 2 == 1) {
      if (line[i] != ' ')
        return refuse(file, number, i + 1,
                      nameOf(line[i]) + " follows a letter; letters are separated by one space");
      if (i + 1 == line.size())
        return refuse(file, number, i + 1, "a space ends the line; it must end with a letter");
      continue;
    }
    const auto kind = kindOf(line[i]);
    if (!kind) return refuse(file, number, i + 1, whyNoLetter(line[i]));
    row.push_back(*kind);
  }
  return row;
}

Result<std::vector<Row>> parseLines(std::string_view text, const std::string& file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.empty())
    return refuse(file, 1, 1, "an empty file; a blueprint has a line of letters for each layer");
  if (text.size() > kMostBlueprintBytes)
    return refuse(file, 1, 1,
                  fmt::format("longer than {} bytes; this is no blueprint", kMostBlueprintBytes));
  if (text.starts_with(kByteOrderMark))
    return refuse(file, 1, 1, "a byte order mark; save the file as plain ASCII text");
  std::vector<Row> rows;
  while (!text.empty()) {
    const std::size_t number = rows.size() + 1, end = text.find('\n');
    if (number > kWallLayers)
      return refuse(file, number, 1,
                    fmt::format("line {}; a wall has at most {} layers", number, kWallLayers));
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    auto row = parseLine(line, file, number);
    if (!row) return tl::make_unexpected(row.error());
    rows.push_back(std::move(*row));
  }
  return rows;
}

Counts countsOf(const Row& row, Counts counts = {}) {
  for (const BrickKind kind : row) ++counts[static_cast<std::size_t>(kind)];
  return counts;
}

std::string inWords(const Counts& counts) {
  return fmt::format("{} R, {} G and {} B", counts[0], counts[1], counts[2]);
}

/// Adds a row to `counts`. @return the first letter that is more than `most` allows.
std::optional<std::size_t> firstSurplus(const Row& row, const Counts& most, Counts& counts) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto kind = static_cast<std::size_t>(row[i]);
    if (++counts[kind] > most[kind]) return i;
  }
  return std::nullopt;
}

Result<void> checkOfficial(const std::vector<Row>& rows, const std::string& file) {
  if (rows.size() != kWallLayers)
    return refuse(file, rows.size() + 1, 1,
                  fmt::format("the file ends after {} lines; the official wall has {} of {} "
                              "letters",
                              rows.size(), kWallLayers, kOfficialBricks));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t letters = rows[i].size();
    if (letters != kOfficialBricks)
      return refuse(file, i + 1, columnOf(std::min(letters, kOfficialBricks)),
                    fmt::format("{} letters in this line; a layer of the official wall has {}",
                                letters, kOfficialBricks));
    Counts counts{};
    if (const auto surplus = firstSurplus(rows[i], kOfficialLayer, counts))
      return refuse(file, i + 1, columnOf(*surplus),
                    fmt::format("one {} too many: {} in this line; each layer has {}",
                                brickShape(rows[i][*surplus]).name, inWords(countsOf(rows[i])),
                                inWords(kOfficialLayer)));
  }
  return {};
}

int modulesOf(BrickKind kind) {
  return static_cast<int>(brickShape(kind).length_m / kModule_m + 0.5);
}

int modulesOf(const Row& row) {
  return std::accumulate(row.begin(), row.end(), 0,
                         [](int sum, BrickKind kind) { return sum + modulesOf(kind); });
}

Result<void> checkLabCounts(const std::vector<Row>& rows, const std::string& file) {
  constexpr const char* kWalls =
      "the lab's wall has {} in all, the official one five lines of seven letters";
  Counts all{}, counted{};
  for (const Row& row : rows) all = countsOf(row, all);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const auto surplus = firstSurplus(rows[i], kLabWall, counted))
      return refuse(file, i + 1, columnOf(*surplus),
                    fmt::format("one {} too many: {} in the file; ",
                                brickShape(rows[i][*surplus]).name, inWords(all)) +
                        fmt::format(kWalls, inWords(kLabWall)));
  if (all == kLabWall) return {};
  return refuse(file, rows.size(), columnOf(rows.back().size()),
                fmt::format("the file ends with {}; ", inWords(all)) +
                    fmt::format(kWalls, inWords(kLabWall)));
}

/// @param below  index step from a row to the one that lies under it: +1 if the top comes first.
Result<void> checkLabSupport(const std::vector<Row>& rows, const std::string& file, int below) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto under = static_cast<std::ptrdiff_t>(i) + below;
    if (under < 0 || under >= static_cast<std::ptrdiff_t>(rows.size())) continue;
    const int borne = modulesOf(rows[static_cast<std::size_t>(under)]);
    int reach = 0;
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      reach += modulesOf(rows[i][k]);
      if (reach > borne)
        return refuse(file, i + 1, columnOf(k),
                      fmt::format("this {} brick ends {:.1f} m from the wall's left edge, the "
                                  "layer below it (line {}) at {:.1f} m; no layer may be longer "
                                  "than the one below",
                                  brickShape(rows[i][k]).name, reach * kModule_m, under + 1,
                                  borne * kModule_m));
    }
  }
  return {};
}

const char* ordinalEnding(std::size_t n) {
  if (n % 100 / 10 == 1) return "th";
  return n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : n % 10 == 3 ? "rd" : "th";
}

}  // namespace

Result<Blueprint> parseBlueprint(std::string_view text, const std::string& file,
                                 BlueprintView view) {
  auto rows = parseLines(text, file);
  if (!rows) return tl::make_unexpected(rows.error());
  std::size_t letters = 0;
  for (const Row& row : *rows) letters += row.size();
  const bool official = letters >= kFewestOfficial;
  auto checked = official ? checkOfficial(*rows, file) : checkLabCounts(*rows, file);
  if (checked && !official) checked = checkLabSupport(*rows, file, view.bottom_first ? -1 : 1);
  if (!checked) return tl::make_unexpected(checked.error());
  if (!view.bottom_first) std::reverse(rows->begin(), rows->end());
  if (view.mirrored)
    for (Row& row : *rows) std::reverse(row.begin(), row.end());
  return Blueprint{std::move(*rows), official};
}

Result<Blueprint> loadBlueprint(const std::string& path, BlueprintView view) {
  const auto text = readRegularFile(path, kMostBlueprintBytes);
  if (!text) return tl::make_unexpected(text.error());
  return parseBlueprint(*text, path, view);
}

std::string formatBlueprint(const Blueprint& blueprint) {
  std::string text;
  for (auto layer = blueprint.layers.rbegin(); layer != blueprint.layers.rend(); ++layer) {
    for (const BrickKind kind : *layer) {
      if (!text.empty() && text.back() != '\n') text += ' ';
      text += brickShape(kind).letter;
    }
    text += "\r\n";
  }
  return text;
}

Result<void> saveBlueprint(const Blueprint& blueprint, const std::string& path) {
  return writeFileAtomically(path, formatBlueprint(blueprint));
}

Blueprint randomBlueprint(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Blueprint blueprint;
  for (std::size_t layer = 0; layer < kWallLayers; ++layer) {
    Row row;
    for (std::size_t kind = 0; kind < kBrickKinds; ++kind)
      row.insert(row.end(), static_cast<std::size_t>(kOfficialLayer[kind]),
                 kBrickShapes[kind].kind);
    // By hand: std::shuffle differs between libraries.
    for (std::size_t i = row.size() - 1; i > 0; --i) std::swap(row[i], row[random() % (i + 1)]);
    blueprint.layers.push_back(std::move(row));
  }
  return blueprint;
}

std::string describeSlot(const WallSlot& slot) {
  return fmt::format("{}, layer {}, {}{} from the left", brickShape(slot.kind).name, slot.layer + 1,
                     slot.index + 1, ordinalEnding(slot.index + 1));
}

}  // namespace kiln
