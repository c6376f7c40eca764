#include "common/core/mutex.h"

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/core/scheduling.h"

namespace kiln {
namespace {

/// As the kernel schedules it now: 20 for an ordinary thread, below zero for a real-time one.
int priorityNow(pid_t thread) {
  std::ifstream in("/proc/self/task/" + std::to_string(thread) + "/stat");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  std::istringstream fields(text.substr(text.rfind(')') + 2));  // from the third field on
  std::string field;
  for (int i = 3; i <= 18; ++i) fields >> field;
  return std::stoi(field);
}

TEST(Mutex, KeepsOthersOutAndWorksWithAConditionVariable) {
  Mutex mutex;
  std::condition_variable_any changed;
  int turns = 0;
  const auto play = [&](int mine) {
    for (int i = 0; i < 1000; ++i) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return turns % 2 == mine; });
      ++turns;
      changed.notify_all();
    }
  };
  std::jthread other([&] { play(1); });
  play(0);
  other.join();
  EXPECT_EQ(turns, 2000);
  const std::lock_guard held(mutex);
  bool got_it = true;
  std::jthread([&] { got_it = mutex.try_lock(); }).join();
  EXPECT_FALSE(got_it);
}

TEST(Mutex, WhoKeepsARealTimeThreadWaitingRunsAtItsPriority) {
  if (!realtimePriority()) GTEST_SKIP() << "no right to real-time priority here";
  Mutex mutex;
  std::unique_lock held(mutex);
  const pid_t holder = ::gettid();
  const int before = priorityNow(holder);
  std::jthread waiter([&] {
    runBeforeOthers();
    const std::lock_guard lock(mutex);
  });
  while (priorityNow(holder) >= 0) std::this_thread::yield();  // ctest's time limit ends a failure
  held.unlock();
  waiter.join();
  EXPECT_EQ(priorityNow(holder), before);
}

}  // namespace
}  // namespace kiln
