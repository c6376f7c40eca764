#include <cmath>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "common/core/units.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/lockstep_world.h"
#include "robot/missions/fire/skills/spray_calibration.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kSpraySeconds = 20.0;
constexpr Duration kStep = std::chrono::milliseconds(8);

/// Holds the head level and sprays at full flow for a while; the world counts where its drops go.
Result<void> sprayLevel(SimLink& link, const Vector6d& q) {
  const Stamp end = link.world().now + fromSeconds(kSpraySeconds);
  for (Stamp t = link.world().now + kStep; t < end; t += kStep) {
    if (auto sent = link.arm().servo({q, Vector6d::Zero()}); !sent) return sent;
    if (auto sent = link.pumps().write({1.0, 1.0}); !sent) return sent;
    if (auto advanced = link.advanceTo(t); !advanced) return advanced;
  }
  return {};
}

Result<json> measure(int seed, const RobotGeometry& robot) {
  const ManualClock clock;
  auto world = LockstepWorld::start("spray", seed, "", clock);
  if (!world) return tl::make_unexpected(world.error());
  if (auto sprayed = sprayLevel((*world)->link(), RobotGeometry::radians(robot.q_drive_deg));
      !sprayed) {
    return tl::make_unexpected(sprayed.error());
  }
  const auto truth = (*world)->end();
  if (!truth) return tl::make_unexpected(truth.error());
  if (!truth->contains("jet_profile"))
    return makeError(ErrorCode::NotFound, "kiln-sim's truth report holds no jet profile");
  return truth->at("jet_profile");
}

}  // namespace

Result<EvaluationResult> calibrateSpray(const SweepOptions& options) {
  const auto robot = loadResource<RobotGeometry>("robot_model/bob.yaml");
  if (!robot) return tl::make_unexpected(robot.error());
  auto profile = measure(options.first_seed, *robot);
  if (!profile) return tl::make_unexpected(profile.error());

  SprayCalibration calibration;
  calibration.distance_m.clear();
  calibration.drop_m.clear();
  calibration.lateral_m.clear();
  double weighted = 0.0, spread_sum = 0.0, count = 0.0;
  for (const auto& row : *profile) {  // {distance_m, drops, drop_m, lateral_m, rms_m}
    const double d = row["distance_m"].get<double>();
    const double n = row["drops"].get<double>();
    if (n < 50) continue;  // too few to mean anything
    calibration.distance_m.push_back(d);
    calibration.drop_m.push_back(row["drop_m"].get<double>());
    calibration.lateral_m.push_back(row["lateral_m"].get<double>());
    weighted += n * d * std::sqrt(9.81 / (2.0 * row["drop_m"].get<double>()));
    spread_sum += n * std::atan(row["rms_m"].get<double>() / d);
    count += n;
  }
  if (calibration.distance_m.size() < 3) {
    return makeError(ErrorCode::Degenerate, "the jet was seen at {} distances only; 3 are needed",
                     calibration.distance_m.size());
  }
  calibration.exit_speed_mps = weighted / count;
  calibration.spread_deg = spread_sum / count / kDeg;
  if (auto valid = calibration.validate(); !valid) return tl::make_unexpected(valid.error());

  std::string path = options.out;
  if (path.empty()) {
    auto folder = resourcePath("config");
    if (!folder) return tl::make_unexpected(folder.error());
    path = *folder + "/spray_calibration.yaml";
  }
  const std::string text =
      "# Where the jet goes: measured in the world by `kiln-eval spray-calibration`.\n" +
      dumpConfig(calibration);
  if (auto written = writeFileAtomically(path, text); !written)
    return tl::make_unexpected(written.error());

  EvaluationResult out;
  out.name = "spray-calibration";
  out.figures = {{"exit_speed_mps", calibration.exit_speed_mps, "m/s", "", true},
                 {"drop_at_0.9_m", calibration.dropAt(0.9), "m", "", true},
                 {"spread_deg", calibration.spread_deg, "deg", "", true}};
  out.runs_json = profile->dump();
  out.notes = "written to " + path;
  return out;
}

}  // namespace kiln
