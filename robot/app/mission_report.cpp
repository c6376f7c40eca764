#include "robot/app/mission_report.h"

#include <nlohmann/json.hpp>

namespace kiln {
namespace {

using nlohmann::json;

constexpr Duration kTrackPeriod = std::chrono::milliseconds(200);

const char* causeName(TransitionCause cause) {
  switch (cause) {
    case TransitionCause::Normal:
      return "normal";
    case TransitionCause::Timeout:
      return "timeout";
    case TransitionCause::Operator:
      return "operator";
    case TransitionCause::Resume:
      return "resume";
    case TransitionCause::Start:
      return "start";
  }
  return "unknown";
}

/// Milliseconds are enough for a reader and keep the file free of rounding noise.
double rounded(Duration d) { return static_cast<double>(d.count() / 1'000'000) / 1000.0; }

/// What the last state says, and after a failure why the mission went there.
std::string reasonOf(const FsmStatus& last, const std::vector<FsmHistoryEntry>& states) {
  const std::string note = states.empty() ? std::string() : states.back().note;
  if (last.success || note.empty() || last.display_text.find(note) != std::string::npos)
    return last.display_text;
  return note + "; " + last.display_text;
}

}  // namespace

void MissionReport::addTrack(const TrackRecord& record) {
  if (!track_.empty() && record.stamp - track_.back().stamp < kTrackPeriod) return;
  track_.push_back(record);
}

std::string MissionReport::toJson(const MissionHost& host, int resets, Stamp now) const {
  const FsmStatus& last = host.fsm();
  const Stamp start = last.step > 0 ? host.log().begun() : created_;
  const std::vector<FsmHistoryEntry>& log = host.log().states();
  json states = json::array();
  for (const FsmHistoryEntry& entry : log) {
    const bool current = entry.left == Stamp{};
    states.push_back({{"name", entry.state},
                      {"enter", rounded(entry.entered - start)},
                      {"leave", rounded((current ? now : entry.left) - start)},
                      {"cause", causeName(entry.cause)},
                      {"note", entry.note}});
  }
  json track = json::array();
  for (const TrackRecord& r : track_) {
    track.push_back({toSeconds(r.stamp), r.X_map_base.x_m, r.X_map_base.y_m, r.X_map_base.yaw_rad,
                     r.X_odom_base.x_m, r.X_odom_base.y_m, r.X_odom_base.yaw_rad, r.located ? 1 : 0,
                     r.indoor ? 1 : 0, r.resets});
  }
  json report{{"mission", host.mission().machine().info().mission},
              {"version", KILN_VERSION},
              {"outcome", !last.terminal ? "unfinished"
                          : last.success ? "success"
                                         : "failed"},
              {"reason", reasonOf(last, log)},
              {"mission_s", rounded(now - start)},
              {"resets", resets},
              {"states", std::move(states)},
              {"track_columns",
               {"t_s", "x_m", "y_m", "yaw_rad", "odom_x_m", "odom_y_m", "odom_yaw_rad", "located",
                "indoor", "resets"}},
              {"track", std::move(track)}};
  host.mission().report(report);
  return report.dump(2) + "\n";
}

}  // namespace kiln
