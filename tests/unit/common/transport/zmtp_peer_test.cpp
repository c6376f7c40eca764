#include "common/transport/zmtp_peer.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/transport/subscriptions.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

std::string greeting() {
  std::string out("\xFF\0\0\0\0\0\0\0\1\x7F\3\1NULL", 16);
  out.resize(64, '\0');
  return out;
}
const std::string kReady("\x04\x1c\5READY\x0bSocket-Type\0\0\0\6DEALER", 30);

ZmtpPeer open() {
  ZmtpPeer peer(ZmtpKind::Router, 1000);
  peer.feed(greeting() + kReady);
  const auto none = peer.next();
  EXPECT_TRUE(none.has_value()) << none.error();
  EXPECT_TRUE(peer.ready());
  (void)peer.takeOutput();
  return peer;
}

std::string errorOf(ZmtpPeer& peer) {
  for (int i = 0; i < 100; ++i) {
    const auto message = peer.next();
    if (!message) return message.error().message;
    if (!*message) return "";
  }
  return "";
}

TEST(ZmtpPeer, TakesMessagesInAnyPieces) {
  const std::string bytes = greeting() + kReady + std::string("\0\5hello", 7) +
                            *frameMessage({std::string(300, 'x')}) + std::string("\0\0", 2);
  for (std::size_t piece = 1; piece < 100; ++piece) {
    ZmtpPeer peer(ZmtpKind::Router, 1000);
    std::vector<std::string> messages;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      peer.feed(std::string_view(bytes).substr(at, piece));
      for (;;) {
        const auto message = peer.next();
        ASSERT_TRUE(message.has_value()) << message.error();
        if (!*message) break;
        messages.emplace_back(**message);
      }
    }
    ASSERT_EQ(messages.size(), 3u) << piece;
    EXPECT_EQ(messages[0], "hello");
    EXPECT_EQ(messages[1], std::string(300, 'x'));
    EXPECT_EQ(messages[2], "");
    EXPECT_EQ(peer.buffered(), 0u);
  }
}

TEST(ZmtpPeer, RefusesALongMessageByItsHeader) {
  ZmtpPeer peer = open();
  peer.feed(std::string("\2\0\0\0\0\x40\0\0\0", 9));  // a gigabyte, none of which has come
  EXPECT_THAT(errorOf(peer), HasSubstr("1073741824 bytes"));
}

TEST(ZmtpPeer, RefusesMessagesOfSeveralParts) {
  ZmtpPeer peer = open();
  peer.feed(std::string("\1\1a", 3));
  EXPECT_THAT(errorOf(peer), HasSubstr("several parts"));
}

TEST(ZmtpPeer, RefusesWhatIsNotZmtp3OrBeginsWithoutReady) {
  for (const std::string& bytes :
       {std::string("GET / HTTP/1.1\r\n"), std::string("\xFF\0\0\0\0\0\0\0\1\x7F\1", 11),
        std::string(64, '\0'), std::string("\1\0", 2)}) {
    ZmtpPeer peer(ZmtpKind::Router, 1000);
    peer.feed(bytes);
    EXPECT_NE(errorOf(peer), "");
  }
  ZmtpPeer early(ZmtpKind::Router, 1000);
  early.feed(greeting() + std::string("\0\1x", 3));
  EXPECT_THAT(errorOf(early), HasSubstr("READY"));
  ZmtpPeer subscriber(ZmtpKind::Publisher, 1000);
  subscriber.feed(greeting() + kReady);
  EXPECT_THAT(errorOf(subscriber), HasSubstr("kind of socket"));
}

TEST(ZmtpPeer, AnswersAPingWithItsContext) {
  ZmtpPeer peer = open();
  peer.feed(std::string("\4\x0a\4PING\0\1abc", 12));
  EXPECT_EQ(errorOf(peer), "");
  EXPECT_EQ(peer.takeOutput(), std::string("\4\x08\4PONGabc", 10));
}

TEST(ZmtpPeer, RandomBytesAreNeverACrashAndHoldNoMoreThanAMessage) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 2000; ++round) {
    ZmtpPeer peer = round % 2 == 0 ? open() : ZmtpPeer(ZmtpKind::Publisher, 1000);
    for (int i = 0; i < 20; ++i) {
      std::string bytes(random() % 100, '\0');
      for (char& c : bytes) c = static_cast<char>(random() % 4 == 0 ? random() : random() % 3);
      peer.feed(bytes);
      if (!errorOf(peer).empty()) break;
      ASSERT_LE(peer.buffered(), 1100u);
    }
  }
}

TEST(Subscriptions, OnlyZeroAndOneAreSubscriptionsAndEachIsOfItsOwnLane) {
  Subscriptions status(Lane::Status);
  EXPECT_EQ(status.take("\1robot_status").size(), 1u);
  EXPECT_TRUE(status.take("\1robot_status").empty());  // wanted already
  for (const char* message : {"\2robot_status", "robot_status", "x", "\xFFrobot_status"}) {
    EXPECT_TRUE(status.take(message).empty());
    EXPECT_TRUE(status.wants(Topic::RobotStatus));
  }
  EXPECT_TRUE(status.take("").empty());
  EXPECT_TRUE(status.take("\1cloud").empty());
  EXPECT_FALSE(status.wants(Topic::Cloud));
  EXPECT_TRUE(status.take(std::string("\0robot_status", 13)).empty());
  EXPECT_FALSE(status.wants(Topic::RobotStatus));
}

TEST(Subscriptions, APrefixIsAllThatItBegins) {
  Subscriptions streams(Lane::Streams);
  EXPECT_EQ(streams.take("\1").size(), 6u);
  EXPECT_TRUE(streams.wants(Topic::Cloud));
  EXPECT_FALSE(streams.wants(Topic::RobotStatus));
  Subscriptions some(Lane::Status);
  EXPECT_EQ(some.take("\1fsm_").size(), 2u);
}

}  // namespace
}  // namespace kiln
