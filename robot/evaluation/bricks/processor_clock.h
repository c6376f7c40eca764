#pragma once

#include <ctime>

#include "common/core/clock.h"

namespace kiln {

/// Processor time of the calling thread: what a computation costs, whatever else the machine does.
class ProcessorClock final : public Clock {
 public:
  [[nodiscard]] Stamp now() const override {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return stampFromNanoseconds(static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec);
  }
};

}  // namespace kiln
