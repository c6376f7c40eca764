#include "common/client/link_talk.h"

namespace kiln {
namespace {

constexpr double kHelloPeriod_s = 0.1;
constexpr double kHeartbeatPeriod_s = 0.2;
constexpr double kFirstHeartbeats_s =
    0.04;  // quick ones after a hello: the clock estimate must not wait
constexpr int kFirstHeartbeats = 8;

}  // namespace

void LinkTalk::heard(std::size_t bytes, Monotonic::time_point now) {
  watch_.heard(now);
  bytes_received_ += bytes;
}

void LinkTalk::onHelloReply(const HelloReply& reply) {
  if (reply.accepted) return watch_.accepted();
  watch_.refused(reply.reason);
  sync_.reset();
}

void LinkTalk::onHeartbeat(const Heartbeat& heartbeat, std::int64_t received_ns,
                           Monotonic::time_point now) {
  // Sent unasked when the robot has not heard us for a while: it keeps the down-link alive and
  // proves nothing else.
  if (heartbeat.station_send_ns == 0) return;
  watch_.robotHeardUs(static_cast<double>(received_ns - heartbeat.station_send_ns) * 1e-9, now);
  sync_.add(heartbeat.station_send_ns, heartbeat.robot_receive_ns, heartbeat.robot_send_ns,
            received_ns);
}

void LinkTalk::onFrame(Topic topic, std::uint64_t lost, std::uint64_t dropped_by_robot) {
  lost_[static_cast<std::size_t>(topic)] += lost;
  robot_dropped_[static_cast<std::size_t>(topic)] = dropped_by_robot;
}

std::optional<ToRobot> LinkTalk::due(Monotonic::time_point now, std::int64_t clock_ns) {
  const auto over = [now](const std::optional<Monotonic::time_point>& last, double period_s) {
    return !last || secondsBetween(*last, now) >= period_s;
  };
  if (!watch_.isAccepted()) {
    if (!over(hello_sent_, kHelloPeriod_s)) return std::nullopt;
    hello_sent_ = now;
    quick_heartbeats_ = kFirstHeartbeats;
    return hello_;
  }
  if (!over(heartbeat_sent_, quick_heartbeats_ > 0 ? kFirstHeartbeats_s : kHeartbeatPeriod_s))
    return std::nullopt;
  heartbeat_sent_ = now;
  if (quick_heartbeats_ > 0) --quick_heartbeats_;
  const auto estimate = sync_.estimate();
  return Heartbeat{++heartbeats_,
                   clock_ns,
                   0,
                   0,
                   watch_.rxAge(now).value_or(0.0),
                   estimate ? estimate->rtt_s : 0.0,
                   sync_.toRobot(clock_ns).value_or(0)};
}

std::optional<std::int64_t> LinkTalk::commandTime(Monotonic::time_point now,
                                                  std::int64_t clock_ns) const {
  LinkReport report;
  watch_.report(now, report);
  if (report.state != LinkState::Connected && report.state != LinkState::Degraded)
    return std::nullopt;
  return sync_.toRobot(clock_ns);
}

LinkReport LinkTalk::report(Monotonic::time_point now, std::uint64_t dropped_sends) const {
  LinkReport report;
  watch_.report(now, report);
  if (const auto estimate = sync_.estimate()) {
    report.clock_known = true;
    report.clock_offset_s = estimate->offset_s;
    report.clock_uncertainty_s = estimate->uncertainty_s;
    report.clock_drift_ppm = estimate->drift_ppm;
    report.rtt_s = estimate->rtt_s;
    report.rtt_p95_s = estimate->rtt_p95_s;
  }
  report.bytes_received = bytes_received_;
  for (const TopicInfo& info : topicTable()) {
    const auto index = static_cast<std::size_t>(info.topic);
    report.drops.push_back({std::string(info.name), lost_[index] + robot_dropped_[index]});
  }
  report.drops.push_back({"commands", dropped_sends});
  return report;
}

}  // namespace kiln
