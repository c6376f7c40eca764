#include "robot/safety/authority.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

/// Steps an authority through time, with anna as its only client.
struct Desk : Authority::Handler {
  struct Result : Authority::Step {
    std::vector<Authority::Accepted> accepted;
    std::vector<HoldKind> released;
    bool lease_lost = false;
  };
  Result result;
  std::uint64_t press = 1;
  Authority authority{Authority::Config{}};
  GateSituation found;
  double now_s = 10.0;
  std::uint64_t nonce = 0;
  bool alive = true;

  Desk() {
    found.mode = Mode::Teleop;
    found.view_age_s = 0.1;
  }
  ReceivedCommand command(CommandBody body) {
    ReceivedCommand received;
    received.command = {"anna",    "Anna", ++nonce,        authority.lease(at(now_s)).epoch,
                        at(now_s), press,  std::move(body)};
    received.received = at(now_s);
    return received;
  }
  [[nodiscard]] GateSituation situation(Stamp) const override { return found; }
  std::optional<CommandAck> execute(const Authority::Accepted& accepted, Stamp) override {
    result.accepted.push_back(accepted);
    if (const auto* mode = std::get_if<SetMode>(&accepted.command.body)) found.mode = mode->mode;
    return std::nullopt;
  }
  void onReleased(const std::vector<HoldKind>& kinds, Stamp) override { result.released = kinds; }
  void onLeaseLost(Stamp) override { result.lease_lost = true; }
  Result step(const std::vector<ReceivedCommand>& commands, bool stop = false) {
    if (stop) {
      found.stop_latched = true;
      ++found.stop_generation;
    }
    result = {};
    std::vector<OperatorPeer> peers(1);
    peers[0].client_id = "anna";
    peers[0].last_heard = alive ? at(now_s) : at(0.0);
    Authority::Step done = authority.step(commands, peers, *this, at(now_s));
    result.acks = std::move(done.acks);
    result.events = std::move(done.events);
    return result;
  }
  void takeControl() {
    ASSERT_EQ(step({command(AcquireLease{})}).acks.at(0).outcome, AckOutcome::Done);
  }
};
const JogBase kForward{{0.3, 0.0, 0.0}};

TEST(Authority, GrantTellsTheEpochThatCommandsMustCarry) {
  Desk desk;
  const auto step = desk.step({desk.command(AcquireLease{})});
  ASSERT_THAT(step.acks, SizeIs(1));
  EXPECT_EQ(step.acks[0].lease_epoch, 1u);
  EXPECT_THAT(desk.step({desk.command(kForward)}).accepted, SizeIs(1));
}

TEST(Authority, StopRevokesEndsHoldsAndRefusesWhatCameWithIt) {
  Desk desk;
  desk.takeControl();
  EXPECT_THAT(desk.step({desk.command(kForward)}).accepted, SizeIs(1));
  const auto epoch = desk.authority.epoch().value();
  const auto step = desk.step({desk.command(kForward)}, true);
  EXPECT_THAT(step.accepted, IsEmpty());
  EXPECT_EQ(step.acks.at(0).code, "no_lease");
  EXPECT_TRUE(step.lease_lost);
  EXPECT_THAT(step.released, Contains(HoldKind::BaseJog));
  EXPECT_GT(desk.authority.epoch().value(), epoch);
  EXPECT_FALSE(desk.authority.held(HoldKind::BaseJog, at(desk.now_s)));
}

TEST(Authority, NothingQueuedDuringSilenceIsExecutedAfterIt) {
  Desk desk;
  desk.takeControl();
  std::vector<ReceivedCommand> queued;
  for (int i = 0; i < 5; ++i) queued.push_back(desk.command(kForward));
  queued.push_back(desk.command(SetMode{Mode::Autonomous}));
  desk.now_s += 3.0;  // the link hung, and delivers everything at once now
  for (auto& command : queued) command.received = at(desk.now_s);
  const auto step = desk.step(queued);
  EXPECT_THAT(step.accepted, IsEmpty());
  for (const CommandAck& ack : step.acks) EXPECT_EQ(ack.code, "too_old");
}

TEST(Authority, AHoldThatALinkGapHasEndedNeedsANewPress) {
  Desk desk;
  desk.takeControl();
  EXPECT_THAT(desk.step({desk.command(kForward)}).accepted, SizeIs(1));
  desk.now_s += 0.4;  // nothing came through
  const auto step = desk.step({desk.command(kForward)});
  EXPECT_THAT(step.accepted, IsEmpty());
  ASSERT_THAT(step.acks, SizeIs(1));
  EXPECT_EQ(step.acks[0].code, "press_over");
  EXPECT_THAT(step.released, Contains(HoldKind::BaseJog));
  ++desk.press;
  EXPECT_THAT(desk.step({desk.command(kForward)}).accepted, SizeIs(1));
}

TEST(Authority, APressRefusedForTheModeStaysRefusedWhenTheModeChanges) {
  Desk desk;
  desk.takeControl();
  desk.found.mode = Mode::Autonomous;
  EXPECT_THAT(desk.step({desk.command(kForward)}).accepted, IsEmpty());
  desk.found.mode = Mode::Teleop;
  EXPECT_EQ(desk.step({desk.command(kForward)}).acks.at(0).code, "press_over");
}

TEST(Authority, EachCommandIsJudgedAgainstWhatTheOneBeforeHasChanged) {
  Desk desk;
  desk.takeControl();
  desk.found.mode = Mode::None;
  desk.found.ready = true;
  const auto step = desk.step({desk.command(SetMode{Mode::Teleop}), desk.command(StartMission{})});
  ASSERT_THAT(step.accepted, SizeIs(1));
  EXPECT_EQ(step.acks.at(0).code, "wrong_mode");
}

TEST(Authority, DeadHolderIsADeadMan) {
  Desk desk;
  desk.takeControl();
  static_cast<void>(desk.step({desk.command(kForward)}));
  desk.alive = false;
  desk.now_s += 0.3;
  EXPECT_THAT(desk.step({}).released, Contains(HoldKind::BaseJog));
  desk.now_s += 2.0;
  const auto step = desk.step({});
  EXPECT_TRUE(step.lease_lost);
  EXPECT_TRUE(desk.authority.lease(at(desk.now_s)).holder_client.empty());
}

TEST(Authority, ARefusedStreamIsAnsweredOnceInAWhile) {
  Desk desk;
  std::size_t answers = 0;
  for (int i = 0; i < 25; ++i) {  // one second at 25 Hz, without control
    answers += desk.step({desk.command(kForward)}).acks.size();
    desk.now_s += 0.04;
  }
  EXPECT_EQ(answers, 5u);
}

TEST(Authority, EachLeaseChangeInvalidatesMultiStepWork) {
  Desk desk;
  const auto before = desk.authority.epoch().value();
  desk.takeControl();
  const auto held = desk.authority.epoch().value();
  EXPECT_GT(held, before);
  desk.now_s += 0.1;
  EXPECT_THAT(desk.step({desk.command(AcquireLease{})}).acks, SizeIs(1));  // keeps it: no change
  EXPECT_EQ(desk.authority.epoch().value(), held);
  EXPECT_TRUE(desk.step({desk.command(ReleaseLease{})}).lease_lost);
  EXPECT_GT(desk.authority.epoch().value(), held);
}

}  // namespace
}  // namespace kiln
