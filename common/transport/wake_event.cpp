#include "common/transport/wake_event.h"

#include <cstdint>

#include <sys/eventfd.h>
#include <unistd.h>

#include "common/core/check.h"

namespace kiln {

WakeEvent::WakeEvent() : fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  KILN_CHECK(fd_ >= 0, "eventfd");
}

WakeEvent::~WakeEvent() { ::close(fd_); }

void WakeEvent::notify() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written =
      ::write(fd_, &one, sizeof one);  // full counter: awake already
}

void WakeEvent::clear() {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto read = ::read(fd_, &count, sizeof count);
}

}  // namespace kiln
