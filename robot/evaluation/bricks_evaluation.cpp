#include <nlohmann/json.hpp>

#include "common/core/clock.h"
#include "robot/evaluation/bricks/brick_trial.h"
#include "robot/evaluation/bricks/processor_clock.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/pile_evaluation.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kTrusted = 0.7, kWrong_m = 0.05;

const char* nameOf(TrialKind kind) {
  return kind == TrialKind::Pile ? "pile" : kind == TrialKind::Lab ? "lab" : "wall";
}
const char* nameOf(BrickFate fate) {
  switch (fate) {
    case BrickFate::InPlace:
      return "in place";
    case BrickFate::Missing:
      return "missing";
    case BrickFate::Fallen:
      return "fallen";
    case BrickFate::Tilted:
      return "tilted";
  }
  return "?";
}

/// What one method makes of many trials.
struct Tally {
  std::vector<double> position_m, yaw_deg, normalised;
  double seen = 0, trusted = 0;  ///< bricks in place and in sight; of these above 0.7
  double wrong = 0;              ///< above 0.7 and off by more than 5 cm, or not there at all
  double refused = 0;
  double disturbed = 0, recognised = 0;
  void add(const BrickOutcome& o, int min_expected) {
    const bool in_sight = o.evidence.expected >= min_expected;
    const bool trusts = o.confidence > kTrusted;
    if (o.fate == BrickFate::InPlace && in_sight) {
      ++seen;
      if (trusts) {
        ++trusted;
        position_m.push_back(o.error_m);
        yaw_deg.push_back(o.yaw_error_deg);
        normalised.push_back(o.normalised);
      }
    }
    if (trusts && (!o.there || o.error_m > kWrong_m)) ++wrong;
    if (o.fate == BrickFate::InPlace || !in_sight) return;
    ++disturbed;
    const bool gone = o.state == BrickState::Missing || o.state == BrickState::Fallen;
    if (o.fate == BrickFate::Tilted ? o.state == BrickState::Tilted : gone) ++recognised;
  }
};

json toJson(const BrickOutcome& o) {
  return {{"id", o.id},
          {"kind", std::string(brickShape(o.kind).name)},
          {"fate", nameOf(o.fate)},
          {"state", std::string(toString(o.state))},
          {"confidence", o.confidence},
          {"expected", o.evidence.expected},
          {"found", o.evidence.found},
          {"empty", o.evidence.empty},
          {"error_m", o.there ? json(o.error_m) : json(nullptr)},
          {"off_m", {o.off_m.x(), o.off_m.y(), o.off_m.z()}},
          {"yaw_error_deg", o.there ? json(o.yaw_error_deg) : json(nullptr)}};
}

class Sweep {
 public:
  Sweep() : ours_({}, &clock_), paper_(paperConfig(), &clock_) {}

  void run(TrialKind kind, int seed, double disturbed, bool calibrated) {
    TrialOptions options;
    options.kind = kind;
    options.disturbed = disturbed;
    if (!calibrated) {
      options.sensor.mount_sigma_m = 0.005;
      options.sensor.mount_sigma_deg = 0.3;
    }
    const BrickTrial trial = makeTrial(options, static_cast<std::uint64_t>(seed));
    Tally& tally = disturbed > 0.0 ? disturbed_ : whole_;
    const Stamp began = clock_.now();
    const auto sight = ours_.perceive(trial.sweep, trial.target);
    const double pipeline_ms = 1e3 * toSeconds(clock_.now() - began);
    json run{{"kind", nameOf(kind)},
             {"seed", seed},
             {"distance_m", trial.distance_m},
             {"disturbed", disturbed > 0.0}};
    if (!sight) {
      ++tally.refused;
      run["refused"] = sight.error().message;
    } else {
      const TargetError target = compareTarget(trial, sight->target.X_base_target);
      run["rough_m"] = target.position_m;
      run["rough_deg"] = target.yaw_deg;
      run["pipeline_ms"] = pipeline_ms;
      run["iterations"] = sight->bricks.iterations;
      for (const BrickOutcome& o : compare(trial, sight->bricks)) {
        tally.add(o, BrickPoseEstimator::Config{}.min_expected);
        run["bricks"].push_back(toJson(o));
      }
      if (disturbed == 0.0) {
        rough_m_.push_back(target.position_m);
        rough_deg_.push_back(target.yaw_deg);
        pipeline_ms_.push_back(pipeline_ms);
        iteration_ms_.push_back(sight->bricks.iteration_ms);
        solve_ms_.push_back(sight->bricks.solve_ms);
      }
    }
    runs_.push_back(run);
    Tally& paper = disturbed > 0.0 ? paper_disturbed_ : paper_whole_;
    const auto theirs = paper_.perceive(trial.sweep, trial.target);
    if (!theirs) {
      ++paper.refused;
      return;
    }
    for (const BrickOutcome& o : compare(trial, theirs->bricks))
      paper.add(o, BrickPoseEstimator::Config{}.min_expected);
    if (disturbed == 0.0) paper_iteration_ms_.push_back(theirs->bricks.iteration_ms);
  }

  [[nodiscard]] EvaluationResult result() const {
    EvaluationResult out;
    out.name = "bricks";
    const auto share = [](double a, double b) { return b > 0.0 ? a / b : 0.0; };
    const auto figure = [&](const char* id, double value, const char* unit) {
      out.figures.push_back({id, value, unit, "", true});
    };
    figure("scenes", static_cast<double>(runs_.size()), "");
    figure("iteration_ms", median(iteration_ms_), "ms");
    figure("solve_ms", median(solve_ms_), "ms");
    figure("pipeline_ms", median(pipeline_ms_), "ms");
    figure("pipeline_p95_ms", quantile(pipeline_ms_, 0.95), "ms");
    figure("rough_median_m", median(rough_m_), "m");
    figure("rough_median_deg", median(rough_deg_), "deg");
    figure("rough_max_m", quantile(rough_m_, 1.0), "m");
    const auto accuracy = [&](const std::string& prefix, const Tally& t) {
      figure((prefix + "position_median_m").c_str(), median(t.position_m), "m");
      figure((prefix + "position_p95_m").c_str(), quantile(t.position_m, 0.95), "m");
      figure((prefix + "yaw_median_deg").c_str(), median(t.yaw_deg), "deg");
      figure((prefix + "yaw_p95_deg").c_str(), quantile(t.yaw_deg, 0.95), "deg");
      figure((prefix + "trusted_share").c_str(), share(t.trusted, t.seen), "");
      figure((prefix + "refused").c_str(), t.refused, "");
    };
    accuracy("", whole_);
    figure("error_over_sigma", median(whole_.normalised), "");
    figure("confidence_wrong", disturbed_.wrong + whole_.wrong, "");
    figure("disturbed_bricks", disturbed_.disturbed, "");
    figure("disturbed_recognised_share", share(disturbed_.recognised, disturbed_.disturbed), "");
    figure("disturbed_trusted_share", share(disturbed_.trusted, disturbed_.seen), "");
    figure("disturbed_refused", disturbed_.refused, "");
    accuracy("paper_", paper_whole_);
    figure("paper_confidence_wrong", paper_disturbed_.wrong + paper_whole_.wrong, "");
    figure("paper_iteration_ms", median(paper_iteration_ms_), "ms");
    out.runs_json = runs_.dump();
    out.notes =
        "a seed is one sweep before a whole pile, lab pile or wall, and two disturbed scenes; "
        "sweeps "
        "from 2 to 3.5 m; position and yaw of bricks trusted above 0.7. paper_: nearest "
        "neighbours, "
        "measured normals, no outline, confidence = found / expected, on the same sweeps (the "
        "paper "
        "names 150 ms an iteration on its computer).";
    return out;
  }

 private:
  static BrickPerception::Config paperConfig() {
    BrickPerception::Config config;
    config.bricks = BrickPoseEstimator::Config::paper();
    return config;
  }
  ProcessorClock clock_;
  BrickPerception ours_, paper_;
  Tally whole_, disturbed_, paper_whole_, paper_disturbed_;
  std::vector<double> rough_m_, rough_deg_, pipeline_ms_, iteration_ms_, solve_ms_;
  std::vector<double> paper_iteration_ms_;
  json runs_ = json::array();
};

}  // namespace

Result<EvaluationResult> evaluateBricks(const SweepOptions& options) {
  if (!options.world.empty()) return evaluatePiles(options);
  Sweep sweep;
  static constexpr TrialKind kKinds[] = {TrialKind::Pile, TrialKind::Wall, TrialKind::Lab};
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    sweep.run(kKinds[seed % 3], seed, 0.0, options.calibrate);
    for (int k = 0; k < 2; ++k)
      sweep.run(kKinds[(seed + k) % 3], 100000 + 2 * seed + k, 0.4, options.calibrate);
  }
  return sweep.result();
}

}  // namespace kiln
