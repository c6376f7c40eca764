#include "robot/scene/blueprint.h"

#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/fuzz/mutator.h"
#include "tests/support/data_dir.h"

namespace kiln {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using enum BrickKind;

const std::string kWall =
    "R G G B R R R\r\nG R R R R B G\r\nG R R B R R G\r\nR G R G R R B\r\nG R B G R R R";
const std::string kLab = "R R R R\nG B\nB G\nG G B\n";

using Row = std::vector<BrickKind>;

TEST(Blueprint, FirstLineIsTheTopLayerWhateverTheLineEnds) {
  std::string unix_text = kWall;
  std::erase(unix_text, '\r');
  for (const std::string& text : {kWall, kWall + "\r\n", unix_text, unix_text + "\n"}) {
    const auto wall = parseBlueprint(text, "w");
    ASSERT_TRUE(wall.has_value()) << wall.error();
    EXPECT_TRUE(wall->orange_leg);
    ASSERT_EQ(wall->layers.size(), 5U);
    EXPECT_EQ(wall->layers[0], (Row{Green, Red, Blue, Green, Red, Red, Red}));
    EXPECT_EQ(wall->layers[4], (Row{Red, Green, Green, Blue, Red, Red, Red}));
  }
}

TEST(Blueprint, CanBeMirroredAndTurnedOver) {
  const auto mirrored = parseBlueprint(kWall, "w", {.mirrored = true});
  ASSERT_TRUE(mirrored.has_value()) << mirrored.error();
  EXPECT_EQ(mirrored->layers[0], (Row{Red, Red, Red, Green, Blue, Red, Green}));
  const auto turned = parseBlueprint(kWall, "w", {.bottom_first = true});
  ASSERT_TRUE(turned.has_value()) << turned.error();
  EXPECT_EQ(turned->layers[0], (Row{Red, Green, Green, Blue, Red, Red, Red}));
}

TEST(Blueprint, OfTheLabHasElevenBricksAndNoOrangeLeg) {
  const auto wall = parseBlueprint(kLab, "lab");
  ASSERT_TRUE(wall.has_value()) << wall.error();
  EXPECT_FALSE(wall->orange_leg);
  ASSERT_EQ(wall->layers.size(), 4U);
  EXPECT_EQ(wall->layers[0], (Row{Green, Green, Blue}));
  // Turned over, 2.4 m would lie on 1.2 m.
  const auto turned = parseBlueprint(kLab, "lab", {.bottom_first = true});
  ASSERT_FALSE(turned.has_value());
  EXPECT_THAT(turned.error().message, HasSubstr("no layer may be longer"));
}

TEST(Blueprint, RandomOnesAreWallsAndComeBackFromTheirText) {
  std::set<std::string> walls;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Blueprint wall = randomBlueprint(seed);
    const std::string text = formatBlueprint(wall);
    const auto read = parseBlueprint(text, "random");
    ASSERT_TRUE(read.has_value()) << read.error();
    EXPECT_EQ(read->layers, wall.layers);
    walls.insert(text);
  }
  EXPECT_GT(walls.size(), 195U);
  // Pinned: the same seed must give the same wall on every machine.
  EXPECT_EQ(formatBlueprint(randomBlueprint(1)).substr(0, 15), "B G R R G R R\r\n");
}

struct BadText {
  std::string name, text, where, what;
};

std::string with(std::string text, std::size_t at, const std::string& piece, std::size_t over = 1) {
  return text.replace(at, over, piece);
}

std::vector<BadText> badTexts() {
  // A line of kWall is 15 bytes long, CR LF included; column 2 i + 1 is letter i.
  return {
      {"empty", "", "w:1:1:", "an empty file"},
      {"orange", with(kWall, 2, "O"), "w:1:3:", "orange leg is implied"},
      {"small letter", with(kWall, 15, "g"), "w:2:1:", "write R, G or B"},
      {"foreign letter", with(kWall, 6, "Y"), "w:1:7:", "'Y'"},
      {"digit", with(kWall, 0, "1"), "w:1:1:", "'1'"},
      {"tab", with(kWall, 1, "\t"), "w:1:2:", "a tab"},
      {"comma", with(kWall, 1, ","), "w:1:2:", "one space"},
      {"two spaces", with(kWall, 1, "  "), "w:1:3:", "a space too many"},
      {"leading space", " " + kWall, "w:1:1:", "a space too many"},
      {"space at the end", with(kWall, 13, " \r"), "w:1:14:", "ends the line"},
      {"letters in one word", with(kWall, 1, "", 1), "w:1:2:", "one space"},
      {"byte order mark", "\xEF\xBB\xBF" + kWall, "w:1:1:", "byte order mark"},
      {"NUL", with(kWall, 4, std::string(1, '\0')), "w:1:5:", "0x00"},
      {"bytes above ASCII", with(kWall, 4, "\xC3\x9C"), "w:1:5:", "0xC3"},
      {"escape", with(kWall, 4, "\x1B"), "w:1:5:", "0x1B"},
      {"carriage returns alone", "R G G B R R R\rG R R R R B G", "w:1:14:", "carriage return"},
      {"empty line", with(kWall, 15, "\r\n", 0), "w:2:1:", "an empty line"},
      {"sixth line", kWall + "\nR G G B R R R", "w:6:1:", "at most 5 layers"},
      {"blank sixth line", kWall + "\n\n", "w:6:1:", "at most 5 layers"},
      {"four lines", kWall.substr(0, 58), "w:5:1:", "ends after 4 lines"},
      {"eight letters", with(kWall, 13, " R\r"), "w:1:15:", "8 letters"},
      {"six letters", with(kWall, 11, "", 2), "w:1:13:", "6 letters"},
      {"a second blue", with(kWall, 0, "B"), "w:1:7:", "one blue too many: 3 R, 2 G and 2 B"},
      {"five red", with(kWall, 6, "R"), "w:1:13:", "one red too many: 5 R, 2 G and 0 B"},
      {"a third green", with(kWall, 15 + 10, "G"), "w:2:13:", "one green too many"},
      {"lab, a fifth red", "R R R R\nR B\nB G\nG G B\n", "w:2:1:", "one red too many"},
      {"lab, three greens", "R R R R\nG B\nB G\nG B\n", "w:4:5:", "ends with 4 R, 3 G and 3 B"},
      {"lab, 2.4 m on 1.8 m", "R R R R G G\nB G\nB G\nB\n", "w:1:11:", "ends 2.4 m"},
      {"three lines of seven", kWall.substr(0, 43), "w:2:3:", "the official one five lines"},
      {"4097 bytes", std::string(4097, 'R'), "w:1:1:", "longer than 4096"},
  };
}

TEST(Blueprint, RefusesWithLineAndColumn) {
  for (const BadText& bad : badTexts()) {
    SCOPED_TRACE(bad.name);
    const auto wall = parseBlueprint(bad.text, "w");
    ASSERT_FALSE(wall.has_value());
    EXPECT_THAT(wall.error().message, AllOf(StartsWith(bad.where), HasSubstr(bad.what)));
  }
}

TEST(Blueprint, AnyBytesAreAWallOrAnError) {
  fuzz::Mutator mutator(11);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string& good = i % 2 == 0 ? kWall : kLab;
    const fuzz::Bytes bytes = mutator.mutate({good.begin(), good.end()});
    const std::string text(bytes.begin(), bytes.end());
    const auto wall = parseBlueprint(text, "w");
    if (!wall) {
      ASSERT_THAT(wall.error().message, StartsWith("w:"));
      continue;
    }
    ++accepted;
    std::size_t bricks = 0;
    for (const Row& row : wall->layers) bricks += row.size();
    ASSERT_EQ(bricks, wall->orange_leg ? 35U : 11U);
    const auto again = parseBlueprint(formatBlueprint(*wall), "again");
    ASSERT_TRUE(again.has_value()) << again.error();
    ASSERT_EQ(again->layers, wall->layers);
  }
  EXPECT_GT(accepted, 10);
}

class BlueprintFile : public ::testing::Test {
 protected:
  BlueprintFile()
      : folder_(std::filesystem::temp_directory_path() /
                ("kiln_blueprint_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~BlueprintFile() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(BlueprintFile, IsWrittenAndReadAgain) {
  const Blueprint wall = randomBlueprint(7);
  ASSERT_TRUE(saveBlueprint(wall, path("wall.txt")).has_value());
  const auto read = loadBlueprint(path("wall.txt"));
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(read->layers, wall.layers);
}

TEST_F(BlueprintFile, OnlyRegularOnesOfASaneSizeAreRead) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::ofstream(path("large")) << std::string(1 << 20, 'R');
  for (const std::string& bad :
       {path("pipe"), path("large"), path("absent"), folder_.string(), std::string("/dev/zero")}) {
    const auto wall = loadBlueprint(bad);  // without waiting for a writer
    ASSERT_FALSE(wall.has_value()) << bad;
    EXPECT_THAT(wall.error().message, HasSubstr(bad));
  }
}

TEST(BlueprintOfOthers, IsRead) {
  const auto file = kiln::testing::dataFile("mbzirc2020_grvc/Wall1.txt");
  if (!file) GTEST_SKIP() << "no blueprints here: set KILN_DATA_DIR";
  const auto wall = loadBlueprint(file->string());
  ASSERT_TRUE(wall.has_value()) << wall.error();
  EXPECT_EQ(wall->layers[0], (Row{Green, Red, Blue, Green, Red, Red, Red}));
  // The wall of the aerial robots: two lines of 21.
  const auto aerial = kiln::testing::dataFile("mbzirc2020_grvc/Wall2.txt");
  ASSERT_TRUE(aerial.has_value());
  const auto refused = loadBlueprint(aerial->string());
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("official wall")) << refused.error();
}

}  // namespace
}  // namespace kiln
