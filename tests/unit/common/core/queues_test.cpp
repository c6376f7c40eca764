#include <memory>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/bounded_queue.h"
#include "common/core/latest_value.h"

namespace kiln {
namespace {

using ::testing::ElementsAre;

TEST(LatestValue, TheNewestWinsAndIsFreshOnce) {
  LatestValue<int> mailbox;
  EXPECT_FALSE(mailbox.takeFresh().has_value());
  mailbox.put(1);
  mailbox.put(2);
  EXPECT_EQ(mailbox.overwritten(), 1U);
  EXPECT_EQ(mailbox.takeFresh(), 2);
  EXPECT_FALSE(mailbox.takeFresh().has_value());
  EXPECT_EQ(mailbox.peek(), 2) << "reading does not remove it";
  mailbox.put(3);
  EXPECT_EQ(mailbox.overwritten(), 1U) << "a value that was read is not a drop";
  mailbox.clear();
  EXPECT_FALSE(mailbox.peek().has_value());
}

TEST(BoundedQueue, DropOldestKeepsTheNewest) {
  BoundedQueue<int> queue(2, DropPolicy::Oldest);
  EXPECT_TRUE(queue.push(1));
  EXPECT_TRUE(queue.push(2));
  EXPECT_FALSE(queue.push(3));
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_THAT(queue.drain(), ElementsAre(2, 3));
  EXPECT_EQ(queue.size(), 0U);
}

TEST(BoundedQueue, DropNewestKeepsTheOldest) {
  BoundedQueue<int> queue(2, DropPolicy::Newest);
  EXPECT_TRUE(queue.push(1));
  EXPECT_TRUE(queue.push(2));
  EXPECT_FALSE(queue.push(3));
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_FALSE(queue.pop().has_value());
}

TEST(BoundedQueue, CarriesValuesThatCannotBeCopied) {
  BoundedQueue<std::unique_ptr<int>> queue(1, DropPolicy::Oldest);
  queue.push(std::make_unique<int>(7));
  EXPECT_EQ(**queue.pop(), 7);
}

TEST(BoundedQueue, LosesNothingUncountedBetweenThreads) {
  BoundedQueue<int> queue(64, DropPolicy::Newest);
  constexpr int kEach = 20000;
  std::size_t received = 0;
  {
    std::jthread a([&] {
      for (int i = 0; i < kEach; ++i) queue.push(i);
    });
    std::jthread b([&] {
      for (int i = 0; i < kEach; ++i) queue.push(i);
    });
    for (int i = 0; i < kEach; ++i) received += queue.drain().size();
  }
  received += queue.drain().size();
  EXPECT_EQ(received + queue.dropped(), 2U * kEach);
}

}  // namespace
}  // namespace kiln
