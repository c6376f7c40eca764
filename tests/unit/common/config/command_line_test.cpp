#include "common/config/command_line.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace kiln {
namespace {

struct Parsed {
  std::optional<int> status;
  double number = 0.5;
  std::uint64_t seed = 1;
  std::string name = "n";
};

Parsed parse(std::vector<std::string> words) {
  Parsed out;
  CLI::App app{"test"};
  app.add_option("--number", out.number)->check(within(0.1, 10.0));
  app.add_option("--seed", out.seed)->check(wholeUpTo(std::numeric_limits<std::uint64_t>::max()));
  app.add_option("--name", out.name)->check(notEmpty());
  words.insert(words.begin(), "test");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  out.status = parseCommandLine(app, static_cast<int>(argv.size()), argv.data());
  testing::internal::GetCapturedStderr();
  testing::internal::GetCapturedStdout();
  return out;
}

TEST(CommandLineOptions, OnlyFiniteNumbersWithinTheirBoundsPass) {
  EXPECT_EQ(parse({"--number", "9.5"}).number, 9.5);
  for (const char* bad : {"nan", "-nan", "inf", "-1", "10.01", "1e999", "", "1x", "0x"})
    EXPECT_EQ(parse({"--number", bad}).status, 2) << bad;
}

TEST(CommandLineOptions, AWholeNumberIsNeitherClampedNorWrapped) {
  EXPECT_EQ(parse({"--seed", "18446744073709551615"}).seed,
            std::numeric_limits<std::uint64_t>::max());
  for (const char* bad : {"-1", "+1", "18446744073709551616", "", "1.5", "1e3", " 1"})
    EXPECT_EQ(parse({"--seed", bad}).status, 2) << bad;
}

TEST(CommandLineOptions, BadInputEndsWithTwoAndHelpWithZero) {
  EXPECT_EQ(parse({"--unknown"}).status, 2);
  EXPECT_EQ(parse({"--name", ""}).status, 2);
  EXPECT_EQ(parse({"--number"}).status, 2);
  EXPECT_EQ(parse({"--help"}).status, 0);
  EXPECT_EQ(parse({}).status, std::nullopt);
}

}  // namespace
}  // namespace kiln
