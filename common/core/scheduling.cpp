#include "common/core/scheduling.h"

#include <cerrno>
#include <cstring>

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/core/log.h"

namespace kiln {
namespace {

constexpr int kPriority = 10;  // of 1 to 99: above all that asks for none, below the kernel's own
constexpr int kNice = 10;

bool setPolicy(int policy, int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return ::sched_setscheduler(0, policy, &parameters) == 0;  // 0: the calling thread
}

/// The only sure way to know is to try.
std::optional<int> tryPriority() {
  const int policy = ::sched_getscheduler(0);
  sched_param before{};
  ::sched_getparam(0, &before);
  if (!setPolicy(SCHED_RR, kPriority)) {
    logger("scheduling")
        ->info(
            "no real-time priority ({}): control may be late while the machine is busy; give "
            "this user the limit 'rtprio'",
            std::strerror(errno));
    return std::nullopt;
  }
  (void)setPolicy(policy, before.sched_priority);
  return kPriority;
}

}  // namespace

std::optional<int> realtimePriority() {
  static const std::optional<int> priority = tryPriority();
  return priority;
}

void runBeforeOthers() {
  if (const auto priority = realtimePriority()) (void)setPolicy(SCHED_RR, *priority);
}

void runAfterOthers() {
  (void)setPolicy(SCHED_OTHER, 0);
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice);  // Linux: of this thread alone
}

}  // namespace kiln
