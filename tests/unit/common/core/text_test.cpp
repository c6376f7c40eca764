#include "common/core/text.h"

#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(Text, LeavesTheLettersOfAllLanguagesAlone) {
  for (const char* name : {"Anna", "Jürgen Ö.", "Ωμέγα", "李雷", "علي", "x<y & z", "🤖 3"}) {
    EXPECT_EQ(printableName(name), name);
  }
}

TEST(Text, NothingThatDrivesATerminalOrForgesALineGetsThrough) {
  EXPECT_EQ(printable("boss\n12:00 info safety: STOP cleared"),
            "boss 12:00 info safety: STOP cleared");
  EXPECT_EQ(printable("a\x1b[2Jb\x07\x7f"), "a?[2Jb??");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31mred"),
            "?31mred");  // the one-character form of ESC [
  EXPECT_EQ(printable("\u202etxt.exe \u2066x\u2069"), "?txt.exe ?x?");
  EXPECT_EQ(printable("an\u200bna\ufeff\u00ad\u3164"), "an?na???");
  EXPECT_EQ(printable("a\u2028b\u2029c"), "a?b?c");
  EXPECT_EQ(printable("tag \U000E0041 \U0010FFFF \uE000"), "tag ? ? ?");
  EXPECT_EQ(printable(std::string("nul\0!", 5)), "nul?!");
}

TEST(Text, WhatIsNoUtf8IsAQuestionMarkAByte) {
  EXPECT_EQ(printable("a\xff\xc0\xaf"), "a???");
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");  // a surrogate
  EXPECT_EQ(printable("cut \xe2\x82"), "cut ??");
}

TEST(Text, NamesHaveAtMost64CharactersAndNoSpaceAround) {
  EXPECT_EQ(printableName("  anna \n"), "anna");
  EXPECT_EQ(printableName(" \t "), "");
  const std::string name = printableName(std::string(70'000, 'x'));
  EXPECT_EQ(name, std::string(63, 'x') + "…");
}

TEST(Text, AnyBytesBecomeShortValidTextAndStayAsTheyAreThen) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(random() % 200, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    const std::string once = printable(bytes);
    EXPECT_EQ(validUtf8(once), once);
    EXPECT_EQ(printable(once), once);
    EXPECT_EQ(printableName(printableName(bytes)), printableName(bytes));
  }
}

}  // namespace
}  // namespace kiln
