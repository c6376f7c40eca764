#include "common/core/check.h"

#include <cstdio>
#include <sstream>

#include <gtest/gtest.h>

#include "common/core/error.h"

namespace kiln {
namespace {

TEST(CheckDeathTest, NamesFileConditionAndValuesRunsTheHandlerAndAborts) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const int litres = 7;
  EXPECT_DEATH(
      {
        setCheckFailureHandler([](const std::string& message) {
          std::fprintf(stderr, "safe stop after <%s>\n",
                       message.substr(message.rfind('[')).c_str());
        });
        KILN_CHECK(litres < 5, "tank overfull", litres);
      },
      "safe stop after <\\[tank overfull, 7\\]>\n.*check_test.cpp:[0-9]+: check failed: litres < 5 "
      "\\[tank overfull, 7\\]");
}

TEST(Check, EvaluatesItsConditionOnceAndPassesInSilence) {
  int evaluations = 0;
  KILN_CHECK(++evaluations == 1);
  EXPECT_EQ(evaluations, 1);
}

TEST(Error, PrintsItsKindAndItsSentence) {
  const Result<int> result = makeError(ErrorCode::Truncated, "{}: {} bytes missing", "a.pcap", 3);
  ASSERT_FALSE(result.has_value());
  std::ostringstream text;
  text << result.error();
  EXPECT_EQ(text.str(), "truncated: a.pcap: 3 bytes missing");
}

}  // namespace
}  // namespace kiln
