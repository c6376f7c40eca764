#include <thread>

#include <gtest/gtest.h>

#include "tests/unit/robot/fsm/kettle.h"

namespace kiln::kettle {
namespace {

struct Pot {
  ManualClock* clock = nullptr;
  Machine* machine = nullptr;
  std::string seen_inside;
  std::string seen_from_elsewhere;
};
class Stuck;
class Off;
class Stuck : public State<Pot, Stuck, To<Off>> {
 public:
  static constexpr const char* kGroup = "";
  static constexpr const char* kDoc = "";
  static constexpr const char* kConsequence = "";
  Transition execute() override;
};
class Off : public State<Pot, Off, To<>, Terminal<true>> {
 public:
  static constexpr const char* kGroup = "";
  static constexpr const char* kDoc = "";
  static constexpr const char* kConsequence = "";
  Transition execute() override { return stay(); }
};
Transition Stuck::execute() {
  Pot& pot = context();
  pot.clock->advanceBy(std::chrono::milliseconds(900));
  pot.seen_inside = pot.machine->blocked();
  pot.clock->advanceBy(std::chrono::milliseconds(300));
  std::jthread([&pot] { pot.seen_from_elsewhere = pot.machine->blocked(); }).join();
  return transit<Off>();
}

TEST(Watchdog, NamesTheStateAndMethodThatBlocks) {
  ManualClock clock;
  Pot pot;
  MachineOf<Pot, Stuck, Off> machine({.mission = "pot"}, clock, pot);
  pot.clock = &clock;
  pot.machine = &machine;
  machine.start("", clock.now());
  machine.step(clock.now());
  EXPECT_EQ(pot.seen_inside, "") << "0.9 s is below the limit of 1 s";
  EXPECT_EQ(pot.seen_from_elsewhere, "Stuck::execute has not returned for 1.2 s");
  clock.advanceBy(std::chrono::seconds(10));
  EXPECT_EQ(machine.blocked(), "") << "it has returned";
}

}  // namespace
}  // namespace kiln::kettle
