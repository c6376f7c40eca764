#include "robot/app/command_inbox.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

ReceivedCommand numbered(std::uint64_t nonce) {
  ReceivedCommand out;
  out.command.nonce = nonce;
  return out;
}

TEST(CommandInbox, AFloodCostsItsSenderAloneAndTheOrderStays) {
  CommandInbox inbox(16);
  EXPECT_TRUE(inbox.push(1, numbered(1)));
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(inbox.push(2, numbered(2)), i < 16);
  EXPECT_TRUE(inbox.push(1, numbered(3)));
  const auto all = inbox.drain();
  ASSERT_EQ(all.size(), 18u);
  EXPECT_EQ(all.front().command.nonce, 1u);
  EXPECT_EQ(all.back().command.nonce, 3u);
  EXPECT_EQ(inbox.dropped(), 984u);
  EXPECT_TRUE(inbox.drain().empty());
  EXPECT_TRUE(inbox.push(2, numbered(4)));
}

}  // namespace
}  // namespace kiln
