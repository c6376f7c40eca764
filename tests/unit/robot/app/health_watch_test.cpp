#include "robot/app/health_watch.h"

#include <atomic>
#include <semaphore>

#include <gtest/gtest.h>

#include "common/core/thread_executor.h"
#include "robot/fsm/machine_of.h"

namespace kiln {
namespace {

struct Kiln {
  std::atomic<bool> released{false};
};
/// A state that does not return until it is let go.
struct Stuck;
struct Open : State<Kiln, Open, To<>, Terminal<true>> {
  static constexpr const char* kGroup = "";
  static constexpr const char* kDoc = "";
  static constexpr const char* kConsequence = "";
  Transition execute() override { return stay(); }
};
struct Stuck : State<Kiln, Stuck, To<Open>> {
  static constexpr const char* kGroup = "";
  static constexpr const char* kDoc = "";
  static constexpr const char* kConsequence = "";
  Transition execute() override {
    context().released.wait(false);
    return transit<Open>();
  }
};

// The watchdog is asked while the thread that it watches stands: in real time, on real threads.
TEST(HealthWatch, TellsTheStationsOfAStateThatDoesNotReturn) {
  const SteadyClock clock;
  Kiln kiln;
  MachineOf<Kiln, Stuck, Open> machine(
      {.mission = "kiln", .watchdog_limit = std::chrono::milliseconds(50)}, clock, kiln);
  Mutex mutex;
  std::binary_semaphore told{0};
  std::vector<RobotStatus> sent;
  HealthWatch health([&machine] { return machine.blocked(); },
                     [&](RobotStatus status) {
                       const std::lock_guard lock(mutex);
                       sent.push_back(std::move(status));
                       kiln.released.store(true);
                       kiln.released.notify_all();
                       (void)told.try_acquire();
                       told.release();
                     });
  RobotStatus before;
  before.robot_name = "Bob";
  health.remember(before);
  machine.start("", clock.now());
  ThreadExecutor executor(clock, 1);
  executor.every(std::chrono::milliseconds(20), "mission", kPriorityMission,
                 [&](Stamp t) { machine.step(t); });
  executor.every(std::chrono::milliseconds(10), "health", kPriorityMission,
                 [&](Stamp t) { health.tick(t); });
  executor.start();
  const bool heard = told.try_acquire_for(std::chrono::seconds(5));
  kiln.released.store(true);  // a failing test ends too
  kiln.released.notify_all();
  executor.stop();
  ASSERT_TRUE(heard) << "within five seconds";
  EXPECT_EQ(sent[0].robot_name, "Bob");
  ASSERT_EQ(sent[0].alarms.size(), 1U);
  EXPECT_EQ(sent[0].alarms[0].id, "fsm.blocked");
  EXPECT_NE(sent[0].alarms[0].text.find("Stuck::execute has not returned"), std::string::npos)
      << sent[0].alarms[0].text;
  EXPECT_NE(health.take(), "") << "and the mission thread learns of it afterwards";
  EXPECT_EQ(health.take(), "");
}

}  // namespace
}  // namespace kiln
