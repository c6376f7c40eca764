#include "robot/safety/replay_filter.h"

#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

using Verdict = ReplayFilter::Verdict;
Stamp at(double s) { return Stamp{fromSeconds(s)}; }

TEST(ReplayFilter, TakesEachNonceOnce) {
  ReplayFilter filter;
  std::mt19937_64 random(3);
  std::uint64_t nonce = 0;
  std::vector<std::uint64_t> used;
  for (int i = 0; i < 2000; ++i) {
    nonce += 1 + random() % 3;
    ASSERT_EQ(filter.check("anna", nonce, false, at(i)), Verdict::Fresh);
    used.push_back(nonce);
    // Any earlier one again, however old.
    ASSERT_EQ(filter.check("anna", used[random() % used.size()], false, at(i)), Verdict::Replayed);
  }
}

TEST(ReplayFilter, ClientsDoNotDisturbEachOther) {
  ReplayFilter filter;
  EXPECT_EQ(filter.check("anna", 5, false, at(0)), Verdict::Fresh);
  EXPECT_EQ(filter.check("ben", 5, false, at(0)), Verdict::Fresh);
}

TEST(ReplayFilter, ZeroIsNoNonce) {
  ReplayFilter filter;
  EXPECT_EQ(filter.check("anna", 0, false, at(0)), Verdict::Replayed);
}

TEST(ReplayFilter, DiscreteCommandsMayOvertakeSetpointsButNotTheReverse) {
  ReplayFilter filter;
  EXPECT_EQ(filter.check("anna", 10, true, at(0)), Verdict::Fresh);
  EXPECT_EQ(filter.check("anna", 9, false, at(0)), Verdict::Fresh);
  EXPECT_EQ(filter.check("anna", 8, true, at(0)), Verdict::OutOfOrder);
  EXPECT_EQ(filter.check("anna", 11, true, at(0)), Verdict::Fresh);
}

TEST(ReplayFilter, ForgetsTheClientThatWasSilentLongest) {
  ReplayFilter filter;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(filter.check("client " + std::to_string(i), 1, false, at(i)), Verdict::Fresh);
  }
  EXPECT_EQ(filter.check("client 99", 1, false, at(200)), Verdict::Replayed);
}

}  // namespace
}  // namespace kiln
