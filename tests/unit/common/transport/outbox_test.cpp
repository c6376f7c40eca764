#include "common/transport/outbox.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

Outbox::Encode text(std::string value) {
  return [value = std::move(value)] { return value; };
}
Monotonic::time_point at(double s) {
  return Monotonic::time_point(
      std::chrono::duration_cast<Monotonic::duration>(std::chrono::duration<double>(s)));
}

TEST(Outbox, NewestWinsAndEveryDropIsCounted) {
  Outbox outbox;
  outbox.setSubscribed(Topic::Cloud, true);
  for (int i = 0; i < 5; ++i) outbox.push(Topic::Cloud, text(std::to_string(i)), Stamp{});
  EXPECT_EQ(outbox.dropped(Topic::Cloud), 3u);
  EXPECT_EQ(outbox.take(at(1.0))->payload, "3");
  EXPECT_EQ(outbox.take(at(2.0))->payload, "4");
  EXPECT_FALSE(outbox.take(at(3.0)).has_value());
}

TEST(Outbox, StatusGoesBeforeStreams) {
  Outbox outbox;
  outbox.setSubscribed(Topic::Cloud, true);
  outbox.setSubscribed(Topic::RobotStatus, true);
  outbox.push(Topic::Cloud, text("cloud"), Stamp{});
  outbox.push(Topic::RobotStatus, text("status"), Stamp{});
  EXPECT_EQ(outbox.take(at(1.0))->topic, Topic::RobotStatus);
}

TEST(Outbox, WhatNobodyWantsIsNeitherEncodedNorCounted) {
  Outbox outbox;
  bool encoded = false;
  outbox.push(
      Topic::Cloud, [&] { return encoded = true, std::string("x"); }, Stamp{});
  EXPECT_FALSE(outbox.take(at(1.0)).has_value());
  EXPECT_FALSE(encoded);
  EXPECT_EQ(outbox.dropped(Topic::Cloud), 0u);
}

TEST(Outbox, LatchedTopicsAreKeptForLateSubscribers) {
  Outbox outbox;
  EXPECT_FALSE(outbox.again(Topic::FsmInfo, Stamp{}).has_value());
  outbox.push(Topic::FsmInfo, text("graph"), Stamp{});
  ASSERT_TRUE(outbox.take(at(1.0)).has_value());
  const auto again = outbox.again(Topic::FsmInfo, Stamp{});
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->payload, "graph");
  EXPECT_EQ(again->header.seq, 2u);
}

TEST(Outbox, RateCapHoldsBackAndDeliversTheNewest) {
  Outbox outbox;  // scene: at most 10 Hz, queue of one
  outbox.setSubscribed(Topic::Scene, true);
  outbox.push(Topic::Scene, text("first"), Stamp{});
  ASSERT_TRUE(outbox.take(at(0.0)).has_value());
  outbox.push(Topic::Scene, text("second"), Stamp{});
  outbox.push(Topic::Scene, text("last"), Stamp{});
  EXPECT_FALSE(outbox.take(at(0.05)).has_value());
  EXPECT_NEAR(outbox.waits(at(0.05)).value(), 0.05, 1e-9);
  EXPECT_EQ(outbox.take(at(0.101))->payload, "last");
  EXPECT_EQ(outbox.dropped(Topic::Scene), 1u);
}

TEST(SequenceCounter, CountsGapsAndStartsAnewWithARestartedRobot) {
  SequenceCounter counter;
  EXPECT_EQ(counter.next(7), 0u);  // joined late: nothing is lost
  EXPECT_EQ(counter.next(8), 0u);
  EXPECT_EQ(counter.next(12), 3u);
  EXPECT_EQ(counter.next(1), 0u);
  EXPECT_EQ(counter.lost(), 3u);
}

TEST(FrameHeader, SurvivesTheWayAndRefusesOtherLengths) {
  const FrameHeader header{~0ull, -5, 1ull << 40};
  const std::string bytes = encodeFrameHeader(header);
  const auto back = decodeFrameHeader(bytes);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->seq, header.seq);
  EXPECT_EQ(back->published_ns, header.published_ns);
  EXPECT_EQ(back->dropped_before, header.dropped_before);
  EXPECT_FALSE(decodeFrameHeader(bytes.substr(1)).has_value());
  EXPECT_FALSE(decodeFrameHeader(bytes + "x").has_value());
}

TEST(Topics, TableIsInTheOrderOfTheEnumAndNoNameIsAPrefixOfAnother) {
  for (std::size_t i = 0; i < kTopicCount; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(topicTable()[i].topic), i);
    EXPECT_EQ(topicByName(topicTable()[i].name), topicTable()[i].topic);
    for (const TopicInfo& other : topicTable()) {  // subscriptions match by prefix
      if (other.topic != topicTable()[i].topic) {
        EXPECT_FALSE(other.name.starts_with(topicTable()[i].name));
      }
    }
  }
}

}  // namespace
}  // namespace kiln
