#include "tests/architecture/mission_words.h"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/paths.h"

namespace kiln::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MissionWords : public ::testing::Test {
 protected:
  MissionWords() {
    std::ifstream in(kiln::sourceDir() + "/tests/architecture/words.txt");
    std::ostringstream text;
    text << in.rdbuf();
    const auto table = WordTable::parse(text.str());
    EXPECT_TRUE(table.has_value()) << table.error();
    if (table) table_ = *table;
  }
  WordTable table_;
};

TEST_F(MissionWords, StandInTheFoldersOfMissionsAlone) {
  for (const std::string& found : missionWordsBelow(table_, kiln::sourceDir()))
    ADD_FAILURE() << found;
}

TEST_F(MissionWords, AreFoundInAnyFormOfAnIdentifier) {
  for (const char* code :
       {"struct FirePlace;", "int fire_places;", "auto n = fireFurniture();", "double kFire = 1;",
        "bool spraying_;", "if (HEAT_MAP) f();", "double litres;", "x.jet.points = 1;",
        "#include \"robot/missions/fire/site.h\""}) {
    EXPECT_THAT(missionWords(table_, "robot/planning/x.cpp", code),
                ElementsAre(HasSubstr("x.cpp:1")))
        << code;
  }
}

TEST_F(MissionWords, AreFreeInTextsCommentsAndOtherRooms) {
  EXPECT_THAT(missionWords(table_, "robot/planning/x.cpp",
                           "log(\"fire \\\" out\");  // the fire\nint template_, misfire, watering;"
                           "int firewall;"),
              ElementsAre(HasSubstr("'watering'")));
  EXPECT_THAT(missionWords(table_, "robot/missions/fire/x.cpp", "int fire;"), IsEmpty());
  EXPECT_THAT(missionWords(table_, "robot/app/x.cpp", "ThermalCamera* thermal;"), IsEmpty());
}

TEST(WordTable, RefusesWhatSaysNothing) {
  EXPECT_FALSE(WordTable::parse("robot/app:\n").has_value());
  EXPECT_FALSE(WordTable::parse("words: fire\nrobot/app\n").has_value());
  EXPECT_FALSE(WordTable::parse("words: fire\nrobot/app: smoke\n").has_value());
}

}  // namespace
}  // namespace kiln::architecture
