#include "gui/models/command_tracker.h"

#include <gtest/gtest.h>

#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

TEST(CommandTracker, FollowsACommandToItsEnd) {
  SteppedStation station;
  const auto nonce = station.models.commands.send(AcquireLease{}, "request the lease");
  ASSERT_NE(station.models.commands.find(nonce), nullptr);
  EXPECT_EQ(station.models.commands.find(nonce)->phase, CommandPhase::Sent);
  station.settle();
  EXPECT_EQ(station.models.commands.find(nonce)->phase, CommandPhase::Done);
}

TEST(CommandTracker, ShowsTheReasonOfARefusal) {
  SteppedStation station;
  const auto nonce = station.models.commands.send(Pause{}, "pause");  // without the lease
  station.settle();
  const TrackedCommand* command = station.models.commands.find(nonce);
  EXPECT_EQ(command->phase, CommandPhase::Refused);
  EXPECT_EQ(command->code, "no_lease");
  EXPECT_FALSE(command->reason.isEmpty());
}

TEST(CommandTracker, CallsACommandUnknownAfterOneSecondAndNeverRepeatsIt) {
  SteppedStation station;
  station.link.setDeaf(true);
  const auto nonce = station.models.commands.send(AcquireLease{}, "request the lease");
  station.pass(0.9);
  EXPECT_EQ(station.models.commands.find(nonce)->phase, CommandPhase::Sent);
  station.pass(0.2);
  EXPECT_EQ(station.models.commands.find(nonce)->phase, CommandPhase::Unknown);
  station.pass(10.0);
  EXPECT_EQ(station.link.sent().size(), 1U);
}

TEST(CommandTracker, IgnoresAnswersToOtherStations) {
  SteppedStation station;
  station.link.setDeaf(true);
  const auto nonce = station.models.commands.send(StartMission{}, "start");
  emit station.link.ack(
      CommandAck{"somebody-else", nonce, "start_mission", AckOutcome::Done, "", "", ""});
  EXPECT_EQ(station.models.commands.find(nonce)->phase, CommandPhase::Sent);
}

}  // namespace
}  // namespace kiln::gui
