#include "common/core/scheduling.h"

#include <thread>

#include <gtest/gtest.h>
#include <sched.h>

namespace kiln {
namespace {

int policyOfThisThread() { return ::sched_getscheduler(0); }

TEST(Scheduling, AThreadRunsBeforeOthersWhereThatIsAllowedAndSoDoItsOwnThreads) {
  const int before = policyOfThisThread();
  const int expected = realtimePriority() ? SCHED_RR : SCHED_OTHER;
  EXPECT_EQ(policyOfThisThread(), before) << "asking changes nothing";
  int own = -1, of_a_child = -1, late = -1;
  std::jthread([&] {
    runBeforeOthers();
    own = policyOfThisThread();
    std::jthread([&] { of_a_child = policyOfThisThread(); }).join();
    runAfterOthers();
    late = policyOfThisThread();
  }).join();
  EXPECT_EQ(own, expected);
  EXPECT_EQ(of_a_child, expected);
  EXPECT_EQ(late, SCHED_OTHER);
  EXPECT_EQ(policyOfThisThread(), before);
}

}  // namespace
}  // namespace kiln
