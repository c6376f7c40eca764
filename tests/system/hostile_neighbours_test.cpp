// kiln-robotd and kiln-sim, as people start them, beside processes that mean harm or are broken.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "common/core/scheduling.h"
#include "common/core/text.h"
#include "common/transport/endpoint.h"
#include "common/wire/command.h"
#include "robot/evaluation/live_system.h"
#include "tests/support/attacks.h"
#include "tests/support/paths.h"
#include "tests/support/raw_zmtp.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using View = ScriptedOperator::View;

constexpr double kMostMiB = 64.0;
constexpr double kStopP99_s = 0.05;
constexpr seconds kReached(2);  // the STOP lane, by who was not connected yet

std::string textOf(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A command client on a plain socket, that says what it is told to.
class Stranger {
 public:
  Stranger(const std::string& address, std::string id) : id_(std::move(id)), socket_(address) {
    EXPECT_TRUE(socket_.shakeHands("DEALER", id_));
  }
  [[nodiscard]] std::optional<HelloReply> hello(ClientRole role = ClientRole::Operator) {
    Hello hello;
    hello.version = KILN_VERSION;
    hello.client_id = id_;
    hello.operator_name = "stranger";
    hello.role = role;
    send(hello);
    return answer<HelloReply>();
  }
  /// @return its answer.
  [[nodiscard]] std::optional<CommandAck> command(CommandBody body, std::uint64_t nonce,
                                                  std::uint64_t lease_epoch) {
    Command command;
    command.client_id = id_;
    command.nonce = nonce;
    command.lease_epoch = lease_epoch;
    command.issued = clock_.now();  // one machine, one clock
    command.body = std::move(body);
    send(command);
    return answer<CommandAck>();
  }
  void send(const ToRobot& message) { socket_.send(wire::encode(message)); }
  void sendBytes(const std::string& bytes) { socket_.send(bytes); }
  template <class T>
  [[nodiscard]] std::optional<T> answer() {
    for (int i = 0; i < 50; ++i) {
      const auto bytes = socket_.receive(milliseconds(500));
      if (!bytes) return std::nullopt;
      const auto message = wire::decodeToStation(*bytes);
      if (message && std::holds_alternative<T>(*message)) return std::get<T>(*message);
    }
    return std::nullopt;
  }
  [[nodiscard]] const Clock& clock() const { return clock_; }

 private:
  std::string id_;
  SteadyClock clock_;
  test::RawZmtp socket_;
};

class HostileNeighbours : public testing::Test {
 protected:
  void SetUp() override {
    auto live = LiveSystem::start(3, {"--report", report_.file("report.json")}, {},
                                  kiln::binaryDir() + "/bin");
    ASSERT_TRUE(live.has_value()) << live.error();
    live_ = std::move(*live);
    auto person = live_->connectOperator("Ann");
    ASSERT_TRUE(person.has_value()) << person.error();
    person_ = std::move(*person);
    ASSERT_TRUE(sees("READY", [](const View& v) {
      return v.status && v.status->word == StatusWord::Ready;
    })) << person_->view().status->reason;
    const auto addresses = parseEndpoint(live_->linkEndpoint());
    ASSERT_TRUE(addresses.has_value()) << addresses.error();
    link_ = *addresses;
    robot_MiB_ = test::residentMiB(live_->robot().pid());
  }
  testing::AssertionResult sees(const std::string& what,
                                const std::function<bool(const View&)>& condition) {
    const auto waited = person_->waitFor(what, seconds(15), condition);
    return waited ? testing::AssertionSuccess() : testing::AssertionFailure() << waited.error();
  }
  /// As a station does: who was displaced before he had shaken hands dials again.
  [[nodiscard]] std::optional<test::RawZmtp> dialStopLane() const {
    const SteadyClock clock;
    for (const Stamp start = clock.now(); clock.now() - start < kReached;) {
      test::RawZmtp lane(link_.stop);
      if (lane.shakeHands("DEALER")) return lane;
      std::this_thread::sleep_for(milliseconds(20));
    }
    return std::nullopt;
  }
  /// From the request to its answer, of `count` STOPs in a row, on a thread that no busy machine
  /// keeps waiting: what is judged is the robot.
  void stopsAreAnswered(const std::string& meanwhile, int count = 100) {
    std::vector<double> answered_s;
    std::jthread([&] {
      runBeforeOthers();
      const SteadyClock clock;
      auto lane = dialStopLane();
      if (!lane) return;
      for (int i = 0; i < count; ++i) {
        const Stamp pressed = clock.now();
        lane->send(wire::encode(StopRequest{"probe", "probe", ++presses_, 0}));
        if (!lane->receive(seconds(1))) return;
        answered_s.push_back(toSeconds(clock.now() - pressed));
        if (lane->receive(std::chrono::milliseconds(15))) return;  // one press, one answer
      }
    }).join();
    ASSERT_EQ(answered_s.size(), static_cast<std::size_t>(count)) << meanwhile;
    std::sort(answered_s.begin(), answered_s.end());
    const double p99_s = answered_s[answered_s.size() * 99 / 100 - 1];
    const double grown_MiB = test::residentMiB(live_->robot().pid()) - robot_MiB_;
    std::printf("%-34s STOP p50 %5.2f p99 %5.2f ms, memory %+.1f MiB\n", meanwhile.c_str(),
                answered_s[answered_s.size() / 2] * 1e3, p99_s * 1e3, grown_MiB);
    EXPECT_LE(p99_s, kStopP99_s) << meanwhile;
    EXPECT_LE(grown_MiB, kMostMiB) << meanwhile;
  }
  void statusComes(const std::string& meanwhile) {
    const auto seq = person_->view().status->seq;
    EXPECT_TRUE(sees("ten more statuses", [&](const View& v) { return v.status->seq > seq + 10; }))
        << meanwhile;
  }
  /// Of a preflight row; empty: it is fine.
  std::string objectionOf(const std::string& row) {
    const View view = person_->view();
    for (const Check& check : view.status->checks) {
      if (check.name == row) return check.ok ? "" : check.detail;
    }
    return "there is no such row";
  }
  ScratchFolder report_{"hostile"};
  std::unique_ptr<LiveSystem> live_;
  std::unique_ptr<ScriptedOperator> person_;
  LinkAddresses link_;
  double robot_MiB_ = 0.0;
  std::uint64_t presses_ = 0;
};

TEST_F(HostileNeighbours, FloodsAndHoardsCostTheRobotNeitherTimeNorMemory) {
  stopsAreAnswered("quiet");
  robot_MiB_ = test::residentMiB(live_->robot().pid());
  const auto log_before = textOf(live_->scratch().file("robotd.log")).size();
  {
    const test::Attack one = test::rubbish(link_.command), two = test::rubbish(link_.command),
                       three = test::rubbish(link_.stop);
    stopsAreAnswered("rubbish");
    statusComes("rubbish");
  }
  EXPECT_LT(textOf(live_->scratch().file("robotd.log")).size() - log_before, 5'000u)
      << textOf(live_->scratch().file("robotd.log")).substr(log_before, 1500);  // what fills it
  {
    const test::Attack one = test::endlessParts(link_.command, "DEALER"),
                       two = test::endlessParts(link_.stop, "DEALER"),
                       three = test::endlessParts(link_.status, "SUB"),
                       four = test::endlessParts(link_.streams, "SUB");
    stopsAreAnswered("endless multipart");
    statusComes("endless multipart");
  }
  {
    const test::Attack one = test::subscriptions(link_.status, 60'000),
                       two = test::subscriptions(link_.streams, 60'000),
                       three = test::userMessages(link_.status),
                       four = test::userMessages(link_.streams);
    stopsAreAnswered("subscriptions");
    statusComes("subscriptions");
  }
  statusComes("after a subscriber has left");
  {
    const test::Attack one = test::crowd(link_.command, 1100), two = test::crowd(link_.stop, 1100),
                       three = test::comingAndGoing(link_.stop);
    stopsAreAnswered("1,100 connections");
    statusComes("1,100 connections");
    auto late = dialStopLane();
    ASSERT_TRUE(late.has_value());
    late->send(wire::encode(StopRequest{"late", "late", 1, 0}));
    EXPECT_TRUE(late->receive(seconds(2)).has_value());
  }
  {
    const test::Attack one = test::deafSubscribers(link_.status, 40),
                       two = test::deafSubscribers(link_.streams, 40);
    stopsAreAnswered("subscribers that do not read");
    statusComes("subscribers that do not read");
  }
  ASSERT_TRUE(live_->robot().running());
  live_->robot().signal(SIGTERM);
  EXPECT_EQ(live_->robot().wait(seconds(5)), 128 + SIGTERM);
  const auto timing = nlohmann::json::parse(textOf(report_.file("report.json.timing")));
  for (const char* loop : {"control", "mission"}) {
    const auto& ticks = timing["ticks"][loop];
    std::printf("%s: %s\n", loop, ticks.dump().c_str());
    // None on a quiet machine; this one also runs the world, the attacks and the tests.
    EXPECT_LE(ticks["slips"].get<int>(), ticks["count"].get<int>() / 50) << loop;
  }
}

TEST_F(HostileNeighbours, NobodyElseIsTheHolderAndNoMessageOfHisIsDoneTwice) {
  ASSERT_TRUE(person_->command(AcquireLease{}).has_value());
  ASSERT_TRUE(sees("the lease", [](const View& v) { return v.lease.mine; }));
  ASSERT_TRUE(person_->command(SetMode{Mode::Teleop}).has_value());
  ASSERT_TRUE(sees("the holder", [](const View& v) {
    return v.status->mode == Mode::Teleop && !v.status->lease.holder_client.empty();
  }));
  const LeaseStatus lease = person_->view().status->lease;

  // As the holder, by his id, which the status shows to everybody.
  Stranger thief(link_.command, lease.holder_client);
  auto reply = thief.hello();
  ASSERT_TRUE(reply.has_value());
  EXPECT_FALSE(reply->accepted);
  EXPECT_FALSE(thief.command(SetMode{Mode::Autonomous}, 1u << 30, lease.epoch).has_value());
  thief.send(ToRobot{Command{lease.holder_client, "x", ~0ull, lease.epoch, thief.clock().now(), 1,
                             JogBase{{0.5, 0.0, 0.0}}}});

  // A viewer that would be more.
  Stranger climber(link_.command, "climber");
  ASSERT_TRUE(climber.hello(ClientRole::Viewer)->accepted);
  EXPECT_FALSE(climber.hello(ClientRole::Supervisor)->accepted);
  const auto taken = climber.command(AcquireLease{true}, 1, 0);
  ASSERT_TRUE(taken.has_value());
  EXPECT_EQ(taken->code, "viewer");

  // A clock that is wrong, and one that cannot be, keep nobody from his start.
  Stranger late(link_.command, "late");
  ASSERT_TRUE(late.hello()->accepted);
  const std::int64_t now_ns = toNanoseconds(late.clock().now());
  for (const std::int64_t estimate : {now_ns + 5'000'000'000, INT64_MIN, INT64_MAX}) {
    Heartbeat heartbeat;
    heartbeat.station_send_ns = now_ns;
    heartbeat.robot_estimate_ns = estimate;
    late.send(heartbeat);
  }
  // The same bytes again: at once, after others, from another connection.
  Command record{"late", "", 10, 0, late.clock().now(), 0, AcknowledgeAlarm{"none"}};
  const std::string bytes = wire::encode(ToRobot{record});
  late.sendBytes(bytes);
  const auto first = late.answer<CommandAck>();
  ASSERT_TRUE(first.has_value());
  EXPECT_NE(first->code, "replayed");
  for (std::uint64_t nonce = 11; nonce < 80; ++nonce)
    ASSERT_TRUE(late.command(AcknowledgeAlarm{"none"}, nonce, 0).has_value());
  late.sendBytes(bytes);
  EXPECT_EQ(late.answer<CommandAck>()->code, "replayed");
  EXPECT_EQ(late.command(AcknowledgeAlarm{"none"}, ~0ull, 0)->code, "bad_number");
  EXPECT_NE(late.command(AcknowledgeAlarm{"none"}, 81, 0)->code, "bad_number");

  // None of it has reached the holder or the robot.
  statusComes("strangers");
  EXPECT_EQ(person_->view().status->mode, Mode::Teleop);
  EXPECT_TRUE(person_->view().lease.mine);
  EXPECT_LT(std::abs(person_->view().status->twist.vx_mps), 0.01);
  EXPECT_EQ(objectionOf("Clocks"), "");
  ASSERT_TRUE(person_->command(SetMode{Mode::Autonomous}).has_value());
  const auto started = person_->command(StartMission{});
  EXPECT_TRUE(started.has_value()) << started.error();
}

TEST_F(HostileNeighbours, AStopCountsWhateverItsSenderCallsHimselfAndIsShownInPrintableText) {
  const std::string name =
      "<img src=\"/dev/zero\">\n12:00 info  safety: STOP cleared\x1b[2J\u202e" +
      std::string(70'000, 'x');
  test::RawZmtp lane(link_.stop);
  ASSERT_TRUE(lane.shakeHands("DEALER"));
  lane.send(wire::encode(StopRequest{"anybody", name, 1, 0}));
  const auto answer = lane.receive(seconds(2));
  ASSERT_TRUE(answer.has_value());
  EXPECT_TRUE(wire::decodeStopAck(*answer)->latched);
  ASSERT_TRUE(sees("STOP", [](const View& v) { return v.status->stop.latched; }));
  EXPECT_EQ(person_->view().status->stop.source, printableName(name));
  for (const char c : textOf(live_->scratch().file("robotd.log")))
    ASSERT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
}

TEST_F(HostileNeighbours, TheWorldIsOneDaemonsAndNoMessageToItIsTooLong) {
  const std::string world = "ipc://" + live_->scratch().file("world");
  const double before_MiB = test::residentMiB(live_->world().pid());
  {
    const test::Attack one = test::gigabyte(world), two = test::rubbish(world),
                       three = test::endlessParts(world, "DEALER"), four = test::crowd(world, 100);
    for (int i = 0; i < 5; ++i) statusComes("a gigabyte to the world");
    auto second =
        ChildProcess::start({kiln::binaryDir() + "/bin/kiln-robotd", "--sim", world, "--state-dir",
                             report_.file("state2"), "--listen", "ipc://" + report_.file("link2")},
                            report_.file("second.log"));
    ASSERT_TRUE(second.has_value());
    EXPECT_EQ(second->wait(seconds(10)), 2);
  }
  EXPECT_THAT(textOf(report_.file("second.log")),
              HasSubstr(fmt::format("in use by daemon {}", live_->robot().pid())));
  EXPECT_LE(test::residentMiB(live_->world().pid()) - before_MiB, kMostMiB);
  EXPECT_EQ(objectionOf("Devices"), "");
}

TEST(HostileTerminal, StandardErrorThatNobodyReadsStopsNothing) {
  const ScratchFolder folder("stderr");
  const std::string world = "ipc://" + folder.file("world"), link = "ipc://" + folder.file("link");
  auto sim = ChildProcess::start({kiln::binaryDir() + "/bin/kiln-sim", "--listen", world},
                                 folder.file("sim.log"));
  ASSERT_TRUE(sim.has_value());
  const std::string pipe = folder.file("stderr");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const UniqueFd unread(::open(pipe.c_str(), O_RDWR | O_CLOEXEC));
  ::fcntl(unread.get(), F_SETPIPE_SZ, 4096);
  ASSERT_TRUE(::write(unread.get(), std::string(4000, '-').data(), 4000) == 4000);  // Ctrl-S
  auto robot =
      ChildProcess::start({kiln::binaryDir() + "/bin/kiln-robotd", "--sim", world, "--state-dir",
                           folder.file("state"), "--listen", link, "--log-level", "1"},
                          pipe);
  ASSERT_TRUE(robot.has_value());
  auto person = ScriptedOperator::connect(link, "Ann", seconds(15));
  ASSERT_TRUE(person.has_value()) << person.error();
  {
    const auto addresses = parseEndpoint(link);
    const test::Attack one = test::rubbish(addresses->command),
                       two = test::endlessParts(addresses->command, "DEALER");
    for (int i = 0; i < 20; ++i) {
      (*person)->session().stop();
      const auto press = (*person)->session().stopReport().press;
      ASSERT_TRUE((*person)
                      ->waitFor("STOP answered", seconds(1),
                                [&](const View& v) {
                                  return v.stop.press == press &&
                                         v.stop.state == StopReport::State::Latched;
                                })
                      .has_value());
      const auto seq = (*person)->view().status ? (*person)->view().status->seq : 0;
      ASSERT_TRUE((*person)
                      ->waitFor("a status", seconds(1),
                                [&](const View& v) { return v.status && v.status->seq > seq; })
                      .has_value());
    }
  }
  robot->signal(SIGTERM);
  EXPECT_EQ(robot->wait(seconds(3)), 128 + SIGTERM);
}

}  // namespace
}  // namespace kiln
