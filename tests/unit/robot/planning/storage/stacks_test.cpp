#include "robot/planning/storage/stacks.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using enum BrickKind;
using Kinds = std::vector<BrickKind>;

/// At most 1.8 m, and what begins above 0.6 m is no longer than 0.6 m.
std::string rule(std::span<const BrickKind> stack) {
  double below = 0.0;
  for (const BrickKind kind : stack) {
    const double length = brickShape(kind).length_m;
    if (below > 0.65 && length > 0.65) return "tips";
    below += length;
    if (below > 1.81) return "too high";
  }
  return {};
}

void expectDivision(const Kinds& sequence, std::size_t bins, const std::vector<Stack>& stacks) {
  EXPECT_LE(stacks.size(), bins);
  std::vector<std::size_t> all;
  for (const Stack& stack : stacks) {
    EXPECT_TRUE(std::is_sorted(stack.rbegin(), stack.rend())) << "the last one built lies lowest";
    Kinds kinds;
    for (const std::size_t brick : stack) kinds.push_back(sequence[brick]);
    EXPECT_EQ(rule(kinds), "");
    all.insert(all.end(), stack.begin(), stack.end());
  }
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), sequence.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
}

TEST(Stacks, AreOfOneKindWhereTheBinsSuffice) {
  const Kinds sequence{Red, Blue, Red, Green, Red, Red, Green, Red, Red, Red};
  const auto stacks = divideIntoStacks(sequence, 4, rule);  // six red, the seventh, green, blue
  ASSERT_TRUE(stacks.has_value());
  expectDivision(sequence, 4, *stacks);
  EXPECT_EQ(mixedStacks(sequence, *stacks), 0);
}

TEST(Stacks, AreMixedAsLittleAsPossibleWhereTheyDoNot) {
  // Heights 0.3 + 1.2 + 0.3 + 0.6: of one kind they take three bins.
  const Kinds sequence{Blue, Red, Green, Red};
  EXPECT_EQ(mixedStacks(sequence, divideIntoStacks(sequence, 3, rule).value()), 0);
  const auto two = divideIntoStacks(sequence, 2, rule);
  ASSERT_TRUE(two.has_value());
  expectDivision(sequence, 2, *two);
  EXPECT_EQ(mixedStacks(sequence, *two), 1);
  EXPECT_FALSE(divideIntoStacks(sequence, 1, rule).has_value());  // 2.4 m
}

TEST(Stacks, FollowTheOrder) {
  // Blue is built last, so it would lie lowest, and 0.6 m more fits on it.
  const auto last = divideIntoStacks(Kinds{Red, Red, Blue}, 1, rule);
  ASSERT_TRUE(last.has_value());
  EXPECT_EQ(last->front(), (Stack{2, 1, 0}));
  // Built first it lies on top of both.
  const auto first = divideIntoStacks(Kinds{Blue, Red, Red}, 1, rule);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->front(), (Stack{2, 1, 0}));
  // On three it would tip.
  EXPECT_FALSE(divideIntoStacks(Kinds{Blue, Red, Red, Red}, 1, rule).has_value());
}

TEST(Stacks, NothingNeedsNothing) {
  const auto none = divideIntoStacks({}, 0, rule);
  ASSERT_TRUE(none.has_value());
  EXPECT_TRUE(none->empty());
}

}  // namespace
}  // namespace kiln
