#include "common/client/link_watch.h"

#include <algorithm>

namespace kiln {

std::string_view toString(LinkState state) {
  switch (state) {
    case LinkState::Connecting:
      return "connecting";
    case LinkState::Connected:
      return "connected";
    case LinkState::Degraded:
      return "degraded";
    case LinkState::Lost:
      return "lost";
    case LinkState::Refused:
      return "refused";
  }
  return "?";
}

void LinkWatch::heard(Monotonic::time_point now) { heard_ = now; }

void LinkWatch::robotHeardUs(double age_s, Monotonic::time_point now) {
  const auto age =
      std::chrono::duration_cast<Monotonic::duration>(std::chrono::duration<double>(age_s));
  robot_heard_us_ = std::max(robot_heard_us_.value_or(Monotonic::time_point{}), now - age);
}

void LinkWatch::accepted() {
  accepted_ = true;
  refusal_.clear();
}

void LinkWatch::refused(const std::string& reason) {
  accepted_ = false;
  refusal_ = reason;
  robot_heard_us_.reset();
}

std::optional<double> LinkWatch::rxAge(Monotonic::time_point now) const {
  if (!heard_) return std::nullopt;
  return secondsBetween(*heard_, now);
}

std::optional<double> LinkWatch::upAge(Monotonic::time_point now) const {
  if (!robot_heard_us_) return std::nullopt;
  return secondsBetween(*robot_heard_us_, now);
}

void LinkWatch::report(Monotonic::time_point now, LinkReport& out) const {
  const auto rx = rxAge(now);
  const auto up = upAge(now);
  out.rx_age_s = rx.value_or(-1.0);
  out.robot_rx_age_s = up.value_or(-1.0);
  out.reason.clear();
  if (rx && *rx > lost_after_s_) {
    out.state = LinkState::Lost;
    out.reason = fmt::format("nothing heard from the robot for {:.1f} s", *rx);
  } else if (!refusal_.empty()) {
    out.state = LinkState::Refused;
    out.reason = refusal_;
  } else if (!accepted_ || !up) {
    out.state = LinkState::Connecting;
    out.reason = rx ? "waiting for the robot's answer to our hello" : "no robot has answered yet";
  } else if (*up > lost_after_s_) {
    out.state = LinkState::Lost;
    out.reason = fmt::format("the robot does not hear us: nothing arrived there for {:.1f} s", *up);
  } else if (*rx > degraded_after_s_ || *up > degraded_after_s_) {
    out.state = LinkState::Degraded;
    out.reason = *rx > *up ? fmt::format("last heard {:.1f} s ago", *rx)
                           : fmt::format("the robot heard us {:.1f} s ago", *up);
  } else {
    out.state = LinkState::Connected;
  }
}

}  // namespace kiln
