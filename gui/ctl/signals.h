#pragma once

namespace kiln::ctl {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGPIPE only set a flag: whoever holds a jog, macro or
/// pump looks at it, sends its zeros and ends in order.
void catchSignals();
[[nodiscard]] bool signalled();

}  // namespace kiln::ctl
