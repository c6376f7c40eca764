#include "common/transport/zmtp_server.h"

#include <filesystem>
#include <map>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/core/log.h"
#include "tests/support/raw_zmtp.h"

namespace kiln {
namespace {

using test::RawZmtp;
using ::testing::HasSubstr;

constexpr Duration kSoon = std::chrono::seconds(5);
constexpr Duration kMoment = std::chrono::milliseconds(50);

/// A server that answers each message with itself, on a thread of its own.
class Echo {
 public:
  explicit Echo(ZmtpServer::Limits limits = {}) {
    address = "ipc:///tmp/kiln-zmtp-" + std::to_string(::getpid());
    auto bound = ZmtpServer::bind(address, ZmtpKind::Router, limits);
    EXPECT_TRUE(bound.has_value()) << bound.error();
    server_ = std::move(*bound);
    server_->setHandlers({[this](PeerId from, std::string_view message) {
                            ++messages;
                            if (message == "keep me") server_->keep(from);
                            (void)server_->send(from, frameMessage({message}));
                          },
                          [this](PeerId) { ++closed; }, [this](PeerId) { ++violations; }});
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        pollfd item{server_->fd(), POLLIN, 0};
        ::poll(&item, 1, 10);
        server_->serve();
      }
    });
  }
  std::string address;
  std::atomic<int> messages{0}, closed{0}, violations{0};

 private:
  std::unique_ptr<ZmtpServer> server_;
  std::jthread thread_;
};

long residentKb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

bool answers(RawZmtp& peer, const std::string& word) {
  return peer.send(word) && peer.receive(kSoon) == word;
}

TEST(ZmtpServer, AnswersEachPeerItself) {
  Echo echo;
  RawZmtp anna(echo.address), ben(echo.address);
  ASSERT_TRUE(anna.shakeHands("DEALER", "same") && ben.shakeHands("DEALER", "same"));
  EXPECT_TRUE(answers(anna, "a"));  // an identity that another has too takes nothing from anybody
  EXPECT_TRUE(answers(ben, "b"));
  EXPECT_TRUE(answers(anna, "c"));
}

TEST(ZmtpServer, WhoBreaksALimitIsClosedAndNamedAndCostsNoMemory) {
  std::vector<std::string> lines;
  std::mutex mutex;
  const LogSinkHandle sink = addLogSink([&](const LogRecord& record) {
    const std::lock_guard lock(mutex);
    lines.push_back(record.text);
  });
  Echo echo;
  RawZmtp good(echo.address);
  ASSERT_TRUE(good.shakeHands("DEALER"));
  const long before_kb = residentKb();
  for (int round = 0; round < 30; ++round) {
    RawZmtp parts(echo.address);
    ASSERT_TRUE(parts.shakeHands("DEALER"));
    for (int i = 0; i < 100 && parts.send(std::string(60'000, 'x'), true); ++i) {
    }
    EXPECT_TRUE(parts.closedWithin(kSoon));
    RawZmtp large(echo.address);
    ASSERT_TRUE(large.shakeHands("DEALER"));
    large.sendRaw(std::string("\2\0\0\0\0\x40\0\0\0", 9));
    EXPECT_TRUE(large.closedWithin(kSoon));
  }
  EXPECT_EQ(echo.violations, 60);
  EXPECT_TRUE(answers(good, "still here"));
  EXPECT_LT(residentKb() - before_kb, 8'000);
  const std::lock_guard lock(mutex);
  EXPECT_LE(lines.size(), 10u);  // of 60
  EXPECT_THAT(lines.at(0), HasSubstr("process " + std::to_string(::getpid())));
  EXPECT_THAT(lines.at(0), HasSubstr("several parts"));
}

TEST(ZmtpServer, ManyConnectionsDisplaceEachOtherAndNobodyWhoIsKnown) {
  ZmtpServer::Limits limits;
  limits.max_peers = 8;
  Echo echo(limits);
  RawZmtp known(echo.address);
  ASSERT_TRUE(known.shakeHands("DEALER") && answers(known, "keep me"));
  std::vector<RawZmtp> crowd;
  for (int i = 0; i < 300; ++i) crowd.emplace_back(echo.address);  // and say nothing
  RawZmtp late(echo.address);
  EXPECT_TRUE(late.shakeHands("DEALER") && answers(late, "room for me"));
  EXPECT_GE(echo.closed, 300 + 2 - 8);
  EXPECT_TRUE(answers(known, "and I"));
}

TEST(ZmtpServer, WhoseHandshakeWaitsToBeReadIsNotDisplacedByACrowdThatSaysNothing) {
  const std::string address = "ipc:///tmp/kiln-zmtp-" + std::to_string(::getpid());
  ZmtpServer::Limits limits;
  limits.max_peers = 8;
  auto server = ZmtpServer::bind(address, ZmtpKind::Router, limits);
  ASSERT_TRUE(server.has_value()) << server.error();
  RawZmtp good(address);
  std::atomic<int> state{0};
  std::jthread speaker([&] { state = good.shakeHands("DEALER") ? 1 : -1; });
  std::this_thread::sleep_for(kMoment);
  std::vector<RawZmtp> crowd;
  for (int i = 0; i < 60; ++i) crowd.emplace_back(address);
  for (const auto start = monotonicNow();
       state == 0 && secondsBetween(start, monotonicNow()) < toSeconds(kSoon);)
    (*server)->serve();
  EXPECT_EQ(state, 1);
}

TEST(ZmtpServer, WithoutDescriptorsItTurnsCallersAwayAndLives) {
  Echo echo;
  RawZmtp good(echo.address);
  ASSERT_TRUE(good.shakeHands("DEALER") && answers(good, "before"));
  std::vector<UniqueFd> all;
  for (int fd = 0; fd >= 0;) all.emplace_back(fd = ::dup(STDERR_FILENO));
  const int last = all[all.size() - 2].get();
  all[all.size() - 2].reset();  // one, for our own end of the connection
  RawZmtp caller(echo.address);
  ASSERT_TRUE(caller.connected()) << last;
  EXPECT_TRUE(caller.closedWithin(kSoon));
  EXPECT_TRUE(answers(good, "after"));
}

TEST(ZmtpServer, AFloodIsReadAtItsSharesPaceAndTheOthersDoNotNotice) {
  Echo echo;
  RawZmtp flood(echo.address), good(echo.address);
  ASSERT_TRUE(flood.shakeHands("DEALER") && good.shakeHands("DEALER"));
  std::jthread rubbish([&](const std::stop_token& stop) {
    const std::string many = [] {
      std::string bytes;
      for (int i = 0; i < 1000; ++i) bytes += test::zmtpFrame("rubbish");
      return bytes;
    }();
    while (!stop.stop_requested() && flood.sendRaw(many)) {
    }
  });
  const auto start = monotonicNow();
  int answered = 0;
  double worst_s = 0.0;
  while (secondsBetween(start, monotonicNow()) < 1.0) {
    const auto sent = monotonicNow();
    ASSERT_TRUE(answers(good, "word"));
    worst_s = std::max(worst_s, secondsBetween(sent, monotonicNow()));
    ++answered;
    ASSERT_FALSE(good.receive(std::chrono::milliseconds(20))) << "one word, one answer";
  }
  EXPECT_GT(answered, 10);
  EXPECT_LT(worst_s, 0.3);
  EXPECT_LT(echo.messages - answered, 100 + 30 + 600);  // burst and two seconds' share
}

TEST(ZmtpServer, APeerThatDoesNotReadLosesMessagesAndTakesNoMemory) {
  ZmtpServer::Limits limits;
  limits.messages_per_s = 1e6;
  limits.bytes_per_s = 1e9;
  Echo echo(limits);
  RawZmtp deaf(echo.address);
  ASSERT_TRUE(deaf.shakeHands("DEALER"));
  const long before_kb = residentKb();
  for (int i = 0; i < 5000; ++i) ASSERT_TRUE(deaf.send(std::string(50'000, 'x')));
  EXPECT_LT(residentKb() - before_kb, 16'000);
}

TEST(ZmtpServer, AGoneServersAddressIsFreeAndASecondOneOnAPortIsRefused) {
  const std::string address = "tcp://127.0.0.1:47391";
  auto first = ZmtpServer::bind(address, ZmtpKind::Router, {});
  ASSERT_TRUE(first.has_value()) << first.error();
  const auto second = ZmtpServer::bind(address, ZmtpKind::Router, {});
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, ErrorCode::Unavailable);
  EXPECT_THAT(second.error().message, HasSubstr("in use"));
  first->reset();
  EXPECT_TRUE(ZmtpServer::bind(address, ZmtpKind::Router, {}).has_value());
  EXPECT_FALSE(ZmtpServer::bind("tcp://127.0.0.1:7410x", ZmtpKind::Router, {}).has_value());
}

}  // namespace
}  // namespace kiln
