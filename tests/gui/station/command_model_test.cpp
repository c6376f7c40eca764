#include "gui/models/command_model.h"

#include <gtest/gtest.h>

#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

TEST(CommandModel, FollowsACommandToItsEnd) {
  SteppedStation station;
  const auto nonce = station.models.commands.send(AcquireLease{}, "request the lease");
  ASSERT_NE(station.models.commands.find(nonce), nullptr);
  EXPECT_EQ(station.models.commands.find(nonce)->state, CommandState::Sent);
  station.settle();
  EXPECT_EQ(station.models.commands.find(nonce)->state, CommandState::Done);
}

TEST(CommandModel, ShowsTheReasonOfARefusal) {
  SteppedStation station;
  const auto nonce = station.models.commands.send(Pause{}, "pause");  // without the lease
  station.settle();
  const TrackedCommand* command = station.models.commands.find(nonce);
  EXPECT_EQ(command->state, CommandState::Refused);
  EXPECT_EQ(command->code, "no_lease");
  EXPECT_FALSE(command->reason.isEmpty());
}

TEST(CommandModel, CallsACommandUnknownAfterOneSecondAndNeverRepeatsIt) {
  SteppedStation station;
  station.link.setDeaf(true);
  const auto nonce = station.models.commands.send(AcquireLease{}, "request the lease");
  station.pass(0.9);
  EXPECT_EQ(station.models.commands.find(nonce)->state, CommandState::Sent);
  station.pass(0.2);
  EXPECT_EQ(station.models.commands.find(nonce)->state, CommandState::Unknown);
  station.pass(10.0);
  EXPECT_EQ(station.link.sent().size(), 1U);
}

}  // namespace
}  // namespace kiln::gui
