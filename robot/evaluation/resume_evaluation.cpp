#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_run.h"
#include "robot/scene/arena_map.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr int kAnywhere = 5, kOnTheWayIn = 3;  // kills a seed
constexpr double kFirst_s = 1.0, kLast_s = 150.0;
constexpr double kRobotLimit_s = 400.0;  // a mission that waits for an operator is ended then

struct KilledMission {
  int seed = 0;
  bool way_in = false;
  Kill wanted;
  Result<MissionRun> run = MissionRun{};
};

/// The kills of one seed, drawn from it. The way in: foot of the ramp to a metre past the edge.
std::vector<KilledMission> killsOf(int seed, const ApproachConfig& approach) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> time_s(kFirst_s, kLast_s);
  std::uniform_real_distribution<double> x_m(approach.foot_x_m, approach.edge_x_m + 1.0);
  std::vector<KilledMission> out;
  for (int i = 0; i < kAnywhere; ++i) out.push_back({seed, false, {.at_s = time_s(random)}});
  for (int i = 0; i < kOnTheWayIn; ++i) out.push_back({seed, true, {.at_x_m = x_m(random)}});
  return out;
}

MissionRunOptions missionOf(const KilledMission& mission) {
  MissionRunOptions options;
  options.seed = mission.seed;
  options.trace = true;
  options.kill = mission.wanted;
  options.robot_args = {"--until-s", fmt::format("{}", kRobotLimit_s)};
  return options;
}

/// What a kill must not count twice: the tries at each place, and the faults on the way in.
int countersOff(const MissionRun& run) {
  const json saved = json::parse(run.checkpoint_json, nullptr, false);
  if (!saved.is_object()) return 1;
  const json& mission = saved.at("body").at("mission");
  int off = mission.at("entry_faults").get<int>() > 0 ? 1 : 0;
  for (const json& place : mission.at("places"))
    for (const char* counter : {"searches", "arm_faults", "drive_faults", "pump_faults"})
      off += place.at(counter).get<int>() > 1 ? 1 : 0;
  return off;
}

json describe(const KilledMission& mission) {
  json out{{"seed", mission.seed}, {"way_in", mission.way_in}};
  if (!mission.run) {
    out["reason"] = mission.run.error().message;
    return out;
  }
  const json report = json::parse(mission.run->report_json);
  out.update({{"outcome", report.at("outcome")},
              {"reason", report.at("reason")},
              {"mission_s", report.at("mission_s")},
              {"litres", report.at("litres_delivered")},
              {"collisions", report.at("collisions").size()},
              {"counters_off", countersOff(*mission.run)}});
  if (mission.run->killed)
    out.update({{"killed_at_s", mission.run->killed->at_s},
                {"killed_at_x_m", mission.run->killed->at_x_m}});
  return out;
}

void runAll(std::vector<KilledMission>& missions, int jobs) {
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> workers;
  for (int worker = 0; worker < std::max(1, jobs); ++worker) {
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < missions.size(); i = next++) {
        missions[i].run = runMission(missionOf(missions[i]));
        fmt::print(stderr, "{}\n", describe(missions[i]).dump());
      }
    });
  }
}

}  // namespace

Result<EvaluationResult> evaluateResume(const SweepOptions& options) {
  const auto arena = loadResource<ArenaMap>("config/arena_kitchen.yaml");
  if (!arena) return tl::make_unexpected(arena.error());
  std::vector<KilledMission> missions;
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed)
    for (KilledMission& mission : killsOf(seed, arena->approach))
      missions.push_back(std::move(mission));
  runAll(missions, options.jobs);

  json runs = json::array();
  double failed = 0, failed_way_in = 0, collisions = 0, counters = 0;
  for (const KilledMission& mission : missions) {
    runs.push_back(describe(mission));
    const bool went_on = mission.run && mission.run->killed && mission.run->success;
    failed += went_on ? 0 : 1;
    failed_way_in += mission.way_in && !went_on ? 1 : 0;
    collisions += runs.back().value("collisions", 0.0);
    counters += runs.back().value("counters_off", 0.0);
  }
  EvaluationResult out;
  out.name = "resume";
  out.figures = {{"kills", static_cast<double>(missions.size()), "", "", true},
                 {"failed", failed, "", "", true},
                 {"failed_way_in", failed_way_in, "", "", true},
                 {"collisions_total", collisions, "", "", true},
                 {"counters_off", counters, "", "", true}};
  out.runs_json = runs.dump();
  out.notes = "Daemon killed and resumed once a mission; nominal mountings, lockstep.";
  return out;
}

}  // namespace kiln
