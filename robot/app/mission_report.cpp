#include "robot/app/mission_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "common/core/atomic_file.h"

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

void MissionReport::observe(const FsmStatus& status) {
  last_ = status;
  for (const FsmHistoryEntry& entry : status.history) {
    if (states_.empty() || entry.step > states_.back().step) {
      states_.push_back(entry);
    } else if (entry.step == states_.back().step) {
      states_.back() = entry;  // now it may have been left
    } else if (states_.size() > 1 && entry.step == states_[states_.size() - 2].step) {
      states_[states_.size() - 2] = entry;
    }
  }
}

void MissionReport::addHeatEstimate(const HeatRecord& record) {
  if (heat_.empty() || record.stamp > heat_.back().stamp) heat_.push_back(record);
}

void MissionReport::addTrack(const TrackRecord& record) {
  if (!track_.empty() && record.stamp - track_.back().stamp < kTrackPeriod) return;
  track_.push_back(record);
  track_resets_.push_back(resets_);
}

void MissionReport::addPlaceCheck(const PlaceCheck& check) {
  const auto same = [&](const PlaceCheck& known) {
    return known.stamp == check.stamp && known.place == check.place;
  };
  if (std::none_of(checks_.begin(), checks_.end(), same)) checks_.push_back(check);
}

std::string MissionReport::toJson(Stamp now) const {
  json states = json::array();
  for (const FsmHistoryEntry& entry : states_) {
    const bool current = entry.left == Stamp{};
    states.push_back({{"name", entry.state},
                      {"enter", rounded(entry.entered - start_)},
                      {"leave", rounded((current ? now : entry.left) - start_)},
                      {"cause", causeName(entry.cause)},
                      {"note", entry.note}});
  }
  json heat = json::array();
  for (const HeatRecord& record : heat_) {
    heat.push_back(
        {{"t", toSeconds(record.stamp)},
         {"p_thermal", {record.p_thermal.x(), record.p_thermal.y(), record.p_thermal.z()}},
         {"range_m", record.range_m},
         {"baseline_range_m", record.baseline_range_m},
         {"views", record.views},
         {"place", record.place}});
  }
  json track = json::array();
  for (std::size_t i = 0; i < track_.size(); ++i) {
    const TrackRecord& r = track_[i];
    track.push_back({toSeconds(r.stamp), r.X_map_base.x_m, r.X_map_base.y_m, r.X_map_base.yaw_rad,
                     r.X_odom_base.x_m, r.X_odom_base.y_m, r.X_odom_base.yaw_rad, r.located ? 1 : 0,
                     r.indoor ? 1 : 0, track_resets_[i]});
  }
  json checks = json::array();
  for (const PlaceCheck& check : checks_) {
    json entry{{"t", toSeconds(check.stamp)},
               {"place", check.place},
               {"verdict", toString(check.verdict)},
               {"offset_m", check.offset_m},
               {"yaw_offset_rad", check.yaw_offset_rad},
               {"coverage", check.coverage},
               {"points", check.points}};
    if (check.X_map_sensed) {
      const Pose2 sensed = projectToGround(*check.X_map_sensed);
      entry["sensed"] = {sensed.x_m, sensed.y_m, sensed.yaw_rad};
    }
    checks.push_back(entry);
  }
  const std::string outcome = !last_.terminal ? "unfinished" : last_.success ? "success" : "failed";
  const json report{{"mission", mission_},
                    {"version", KILN_VERSION},
                    {"outcome", outcome},
                    {"reason", reasonOf(last_, states_)},
                    {"mission_s", rounded(now - start_)},
                    {"litres_est", litres_est_},
                    {"resets", resets_},
                    {"states", states},
                    {"heat_estimates", heat},
                    {"track_columns",
                     {"t_s", "x_m", "y_m", "yaw_rad", "odom_x_m", "odom_y_m", "odom_yaw_rad",
                      "located", "indoor", "resets"}},
                    {"track", track},
                    {"place_checks", checks}};
  return report.dump(2) + "\n";
}

Result<void> MissionReport::write(const std::string& path, Stamp now) const {
  return writeFileAtomically(path, toJson(now));
}

}  // namespace kiln
