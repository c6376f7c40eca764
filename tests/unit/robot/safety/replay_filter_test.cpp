#include "robot/safety/replay_filter.h"

#include <algorithm>
#include <random>
#include <set>

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

TEST(ReplayFilter, WhateverWasTakenIsNeverTakenAgain) {
  std::mt19937_64 random(11);
  ReplayFilter filter;
  std::set<std::uint64_t> taken;
  std::uint64_t highest = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t nonce =
        random() % 3 == 0 ? highest + 1 + random() % 100 : 1 + random() % (highest + 1);
    const bool fresh = filter.check("anna", nonce, false, at(0)) == Verdict::Fresh;
    EXPECT_FALSE(fresh && taken.contains(nonce)) << nonce;
    if (fresh) taken.insert(nonce);
    highest = std::max(highest, fresh ? nonce : 0);
  }
  // The case that a list of the last 64 gets wrong.
  EXPECT_EQ(filter.check("ben", 10, false, at(0)), Verdict::Fresh);
  EXPECT_EQ(filter.check("ben", 3, false, at(0)), Verdict::Fresh);
  for (std::uint64_t n = 11; n < 75; ++n) (void)filter.check("ben", n, false, at(0));
  EXPECT_EQ(filter.check("ben", 10, false, at(0)), Verdict::Replayed);
  EXPECT_EQ(filter.check("ben", 3, false, at(0)), Verdict::Replayed);
}

TEST(ReplayFilter, NoSingleNumberEndsAClientsNumbers) {
  for (const std::uint64_t poison : {~0ull, ~0ull - 1, 1ull << 63, (1ull << 62) + 1}) {
    ReplayFilter filter;
    EXPECT_EQ(filter.check("anna", poison, true, at(0)), Verdict::Implausible);
    EXPECT_EQ(filter.check("anna", 5, true, at(0)), Verdict::Fresh);
    EXPECT_EQ(filter.check("anna", poison, true, at(0)), Verdict::Implausible);
    EXPECT_EQ(filter.check("anna", 6, true, at(0)), Verdict::Fresh);
  }
}

TEST(ReplayFilter, AClientThatComesBackToANewDaemonGoesOnWithItsNumbers) {
  ReplayFilter filter;
  EXPECT_EQ(filter.check("anna", 50'000'000, false, at(0)), Verdict::Fresh);
  EXPECT_EQ(filter.check("anna", 50'000'001, false, at(0)), Verdict::Fresh);
}

TEST(ReplayFilter, OthersCannotMakeItForgetAClientWhileItsCommandsAreYoung) {
  ReplayFilter filter;
  EXPECT_EQ(filter.check("anna", 1, false, at(0)), Verdict::Fresh);
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto verdict = filter.check("client " + std::to_string(i), 1, false, at(1));
    refused += verdict == Verdict::TooMany ? 1 : 0;
  }
  EXPECT_GT(refused, 0);
  EXPECT_EQ(filter.check("anna", 1, false, at(9)), Verdict::Replayed);
  EXPECT_EQ(filter.check("anna", 2, false, at(9)), Verdict::Fresh);
  // Bounded: who was silent for so long that nothing of it could be obeyed makes room.
  EXPECT_EQ(filter.check("late", 1, false, at(60)), Verdict::Fresh);
}

}  // namespace
}  // namespace kiln
