#include <filesystem>
#include <optional>
#include <random>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "common/robot_model/robot_calibration.h"
#include "robot/app/robot_settings.h"
#include "robot/app/safety_files.h"
#include "robot/evaluation/base_trace.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_run.h"
#include "robot/evaluation/recorded_scans.h"
#include "robot/evaluation/yard_calibration.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kFarthest_m = 1.0, kFarthest_deg = 20.0;
constexpr double kFound_m = 0.10, kFound_deg = 2.0;
constexpr int kTrialsASeed = 50;
constexpr int kScansATrial = 20;  // two seconds
constexpr int kScansBetween = 28;

enum class Verdict { Recovered, Lost, Wrong };

struct Trial {
  double t_s = 0.0;  ///< when it was judged
  Pose2 off;         ///< how wrong the start pose was, in base
  Verdict verdict = Verdict::Lost;
  double error_m = 0.0, error_deg = 0.0;
  int first_fix = 0;  ///< scans until the pose was known; 0: never
};

/// What every trial of one seed works with.
struct Bench {
  RobotGeometry robot;
  ArenaMap arena;
  Localizer::Config localizer;
  std::unique_ptr<ScanLocator> locator;
  BaseTrace truth{""};
};

/// Starts anew with a wrong pose wherever the robot is, looks at the scans that follow, judges.
class Trials {
 public:
  Trials(const Bench& bench, int seed) : bench_(bench), random_(static_cast<unsigned>(seed)) {}

  void add(const RecordedScan& scan) {
    if (static_cast<int>(trials_.size()) == kTrialsASeed) return;
    if (!localizer_ && ++waited_ >= kScansBetween - kScansATrial) begin(scan);
    if (!localizer_) return;
    Localizer& localizer = *localizer_;
    const Stamp t = scan.scan_base.stamp;
    localizer.addOdometry(t, scan.X_odom_base);
    if (const auto prior = localizer.priorAt(t)) {
      const auto match = bench_.locator->locate(scan.scan_base, scan.p_base_sensor, *prior);
      (void)localizer.addResult(*prior, match);
    }
    ++looked_;
    if (trial_.first_fix == 0 && localizer.pose(t).health != PoseHealth::Lost)
      trial_.first_fix = looked_;
    if (looked_ == kScansATrial) judge(t);
  }
  [[nodiscard]] const std::vector<Trial>& trials() const { return trials_; }

 private:
  void begin(const RecordedScan& scan) {
    const auto truth = bench_.truth.at(toSeconds(scan.scan_base.stamp));
    if (!truth) return;
    // Even over the disc and the angles.
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double way = kFarthest_m * std::sqrt(share(random_));
    const double bearing = 2.0 * M_PI * share(random_);
    trial_ = {};
    trial_.off = {way * std::cos(bearing), way * std::sin(bearing),
                  kFarthest_deg * kDeg * (2.0 * share(random_) - 1.0)};
    localizer_.emplace(bench_.localizer, bench_.arena, bench_.robot);
    localizer_->reset(*truth * trial_.off, scan.scan_base.stamp);
    waited_ = looked_ = 0;
  }
  void judge(Stamp t) {
    const TrackedPose pose = localizer_->pose(t);
    localizer_.reset();
    const auto truth = bench_.truth.at(toSeconds(t));
    if (!truth) return;
    trial_.t_s = toSeconds(t);
    trial_.error_m = std::hypot(pose.X_map_base.x_m - truth->x_m, pose.X_map_base.y_m - truth->y_m);
    trial_.error_deg = std::abs(wrapAngle(pose.X_map_base.yaw_rad - truth->yaw_rad)) / kDeg;
    const bool right = trial_.error_m < kFound_m && trial_.error_deg < kFound_deg;
    trial_.verdict = pose.health == PoseHealth::Lost ? Verdict::Lost
                     : right                         ? Verdict::Recovered
                                                     : Verdict::Wrong;
    trials_.push_back(trial_);
  }

  const Bench& bench_;
  std::mt19937 random_;
  std::optional<Localizer> localizer_;
  int waited_ = 0, looked_ = 0;
  Trial trial_;
  std::vector<Trial> trials_;
};

/// One mission, recorded. @return the recording's path.
Result<std::string> recordMission(int seed, const std::string& calibration,
                                  const ScratchFolder& scratch, MissionRun& run) {
  MissionRunOptions options;
  options.seed = seed;
  options.trace = true;
  options.robot_args = {"--record", scratch.path()};
  if (!calibration.empty())
    options.robot_args.insert(options.robot_args.end(), {"--calibration", calibration});
  auto ran = runMission(options);
  if (!ran) return tl::make_unexpected(ran.error());
  run = std::move(*ran);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.path()))
    if (entry.path().extension() == ".mcap") return entry.path().string();
  return makeError(ErrorCode::NotFound, "seed {}: kiln-robotd left no recording", seed);
}

Result<std::vector<Trial>> tryOut(int seed, bool calibrate) {
  std::string calibration;
  Bench bench;
  auto robot = nominalRobot();
  if (!robot) return tl::make_unexpected(robot.error());
  if (calibrate) {
    auto file = calibrationOf(*yardOf(""), seed, calibrationCache());
    if (!file) return tl::make_unexpected(file.error());
    calibration = *file;
    robot = loadCalibrated(calibration, *robot);
    if (!robot) return tl::make_unexpected(robot.error());
  }
  bench.robot = *robot;
  auto settings = loadResource<RobotSettings>("config/robot.yaml");
  if (!settings) return tl::make_unexpected(settings.error());
  auto arena = loadArena(settings->arena);
  if (!arena) return tl::make_unexpected(arena.error());
  bench.arena = *arena;
  bench.localizer = settings->localization.localizerConfig();
  auto location = makeLocation(settings->localization, *arena);
  if (!location) return tl::make_unexpected(location.error());
  bench.locator = std::move(location->locator);

  const ScratchFolder scratch("relocalization");
  MissionRun run;
  const auto recording = recordMission(seed, calibration, scratch, run);
  if (!recording) return tl::make_unexpected(recording.error());
  bench.truth = BaseTrace(run.trace_jsonl);
  Trials trials(bench, seed);
  auto read = forEachScan(*recording, bench.robot, [&](const RecordedScan& scan) -> Result<void> {
    trials.add(scan);
    return {};
  });
  if (!read) return tl::make_unexpected(read.error());
  return trials.trials();
}

const char* nameOf(Verdict verdict) {
  return verdict == Verdict::Recovered ? "recovered" : verdict == Verdict::Lost ? "lost" : "wrong";
}

}  // namespace

Result<EvaluationResult> evaluateRelocalization(const SweepOptions& options) {
  EvaluationResult out;
  out.name = "relocalization";
  json runs = json::array();
  double recovered = 0, lost = 0, wrong = 0;
  std::vector<double> error_m, error_deg, first_fix_s;
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    const auto trials = tryOut(seed, options.calibrate);
    if (!trials) return tl::make_unexpected(trials.error());
    for (const Trial& trial : *trials) {
      (trial.verdict == Verdict::Recovered ? recovered
       : trial.verdict == Verdict::Lost    ? lost
                                           : wrong) += 1;
      if (trial.verdict == Verdict::Recovered) {
        error_m.push_back(trial.error_m);
        error_deg.push_back(trial.error_deg);
        first_fix_s.push_back(0.1 * trial.first_fix);
      }
      runs.push_back({{"seed", seed},
                      {"t_s", trial.t_s},
                      {"off_m", std::hypot(trial.off.x_m, trial.off.y_m)},
                      {"off_deg", trial.off.yaw_rad / kDeg},
                      {"verdict", nameOf(trial.verdict)},
                      {"error_m", trial.error_m},
                      {"error_deg", trial.error_deg}});
    }
  }
  const double count = std::max(1.0, recovered + lost + wrong);
  out.figures = {{"trials", recovered + lost + wrong, "", "", true},
                 {"recovered_share", recovered / count, "", "", true},
                 {"lost_and_said_so", lost, "", "", true},
                 {"wrong_unnoticed", wrong, "", "", true},
                 {"position_median_m", median(error_m), "m", "", true},
                 {"position_p95_m", quantile(error_m, 0.95), "m", "", true},
                 {"yaw_p95_deg", quantile(error_deg, 0.95), "deg", "", true},
                 {"first_fix_median_s", median(first_fix_s), "s", "", true},
                 {"first_fix_max_s", quantile(first_fix_s, 1.0), "s", "", true}};
  out.runs_json = runs.dump();
  out.notes =
      "start poses off by up to 1 m and 20 deg, even over the disc, at moments spread over "
      "each mission; judged after 2 s of scans: recovered = within 10 cm and 2 deg.";
  return out;
}

}  // namespace kiln
