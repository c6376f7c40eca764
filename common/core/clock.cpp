#include "common/core/clock.h"

#include <fmt/chrono.h>

#include "common/core/check.h"

namespace kiln {

Stamp SteadyClock::now() const {
  return Stamp{
      std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch())};
}

void ManualClock::advanceTo(Stamp t) {
  KILN_CHECK(t >= now(), "clock would run backwards", toSeconds(now()), toSeconds(t));
  now_ns_.store(toNanoseconds(t));
}

std::string wallTimeIso8601() {
  const std::time_t t = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(t));
}

}  // namespace kiln
