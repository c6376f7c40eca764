#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "common/geom/camera_model.h"
#include "common/robot_model/robot_geometry.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/live_system.h"
#include "robot/evaluation/truth.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {
namespace {

using nlohmann::json;
using std::chrono::seconds;

constexpr double kSpraySeconds = 25.0;
constexpr double kHot_k = 273.15 + 78.0;
constexpr double kJetSpeed_mps = 6.0;
constexpr double kGravity_mps2 = 9.81;

/// Where in the thermal picture a heat source must stand for the jet of the level head to hit it:
/// the operator's aim mark, from the nozzle's offset and the sag of the jet at the opening.
Eigen::Vector2d aimMark(const RobotGeometry& robot, double plate_ahead_of_flange_m,
                        double recess_m) {
  const CameraModel camera = CameraModel::fromHorizontalFov(160, 120, 57.0 * kDeg);
  const Eigen::Isometry3d X_thermal_nozzle =
      robot.X_flange_thermal.pose().inverse() * robot.X_flange_nozzle.pose();
  const double nozzle_to_opening =
      plate_ahead_of_flange_m - recess_m - robot.X_flange_nozzle.pose().translation().z();
  const double sag = 0.5 * kGravity_mps2 * std::pow(nozzle_to_opening / kJetSpeed_mps, 2);
  const Eigen::Vector3d target(
      X_thermal_nozzle.translation().x(), X_thermal_nozzle.translation().y() + sag,
      plate_ahead_of_flange_m - robot.X_flange_thermal.pose().translation().z());
  return *camera.project(target);
}

std::optional<HeatBlob> hottest(const ScriptedOperator::View& view) {
  if (!view.stream || view.stream->schema != fire::kHeatSchema) return std::nullopt;
  const auto heat = wire::decodeHeat(view.stream->data);
  if (!heat || !heat->usable || heat->blobs.empty()) return std::nullopt;
  const auto& blobs = heat->blobs;
  const auto best =
      std::max_element(blobs.begin(), blobs.end(),
                       [](const HeatBlob& a, const HeatBlob& b) { return a.peak_k < b.peak_k; });
  return best->peak_k > kHot_k ? std::optional(*best) : std::nullopt;
}

/// Jogs the arm sideways and up or down until the hot spot stands on the aim mark.
Result<void> aimByHand(ScriptedOperator& person, const Eigen::Vector2d& mark) {
  return person.holdWhile("aiming by hand", seconds(40),
                          [&](const auto& view) -> std::optional<CommandBody> {
                            const auto blob = hottest(view);
                            JogArm jog;
                            jog.frame = JogFrame::Tool;  // X right, Y down in the picture
                            if (!blob) return jog;       // look on, do not move
                            const double du = blob->u - mark.x(), dv = blob->v - mark.y();
                            if (std::hypot(du, dv) < 1.0) return std::nullopt;
                            constexpr double kGain_mps_per_px = 0.004;
                            jog.velocity[0] = std::clamp(kGain_mps_per_px * du, -0.1, 0.1);
                            jog.velocity[1] = std::clamp(kGain_mps_per_px * dv, -0.1, 0.1);
                            return jog;
                          });
}

Result<bool> tryPlace(ScriptedOperator& person, const RobotGeometry& robot, double recess_m,
                      const FirePlaceConfig& place) {
  for (const GroundPoseConfig& via : place.via) {
    if (auto drive = person.driveTo(via.pose(), 0.10); !drive)
      return tl::make_unexpected(drive.error());
  }
  if (auto drive = person.driveTo(place.work_pose.pose(), 0.015); !drive)
    return tl::make_unexpected(drive.error());
  // The plate needs about a minute to get hot.
  const bool burning =
      person.waitFor("heat", seconds(45), [](const auto& v) { return hottest(v).has_value(); })
          .has_value();
  if (!burning) return false;
  const double plate_ahead_of_base = std::hypot(place.plate_xyz_m[0] - place.work_pose.xy_m[0],
                                                place.plate_xyz_m[1] - place.work_pose.xy_m[1]);
  const Vector6d q = person.view().status->arm.q;
  const Eigen::Vector2d mark =
      aimMark(robot, plate_ahead_of_base - robot.X_base_flange(q).translation().x(), recess_m);
  if (auto aimed = aimByHand(person, mark); !aimed) return tl::make_unexpected(aimed.error());
  const SteadyClock clock;
  const Stamp until = clock.now() + fromSeconds(kSpraySeconds);
  auto sprayed = person.holdWhile("spraying by hand", seconds(60),
                                  [&](const auto&) -> std::optional<CommandBody> {
                                    if (clock.now() > until) return std::nullopt;
                                    return HoldActuator{kPumps, 1.0};
                                  });
  if (!sprayed) return tl::make_unexpected(sprayed.error());
  return true;
}

Result<void> playByHand(ScriptedOperator& person, const RobotGeometry& robot, const ArenaMap& arena,
                        const FireSiteMap& site) {
  // The mission's clock runs, and the fire burns, from its start; then the autonomy is given up.
  if (auto started =
          person.waitFor("the mission's start", seconds(60),
                         [](const auto& v) { return v.status->phase == MissionPhase::Running; });
      !started)
    return started;
  if (auto over = person.takeOver(); !over) return over;
  if (auto scale = person.command(SetSpeedScale{1.0}); !scale) return scale;
  for (const GroundPoseConfig& waypoint : arena.entry_path) {
    if (auto drive = person.driveTo(waypoint.pose(), 0.10); !drive) return drive;
  }
  for (const FirePlaceConfig& place : site.places) {
    auto done = tryPlace(person, robot, site.recess_m, place);
    if (!done) return tl::make_unexpected(done.error());
    if (*done) return {};
    const Pose2 hub = arena.entry_path.back().pose();
    if (auto back = person.driveTo(hub, 0.15); !back) return back;
  }
  return makeError(ErrorCode::NotFound, "no place looked hot");
}

}  // namespace

Result<EvaluationResult> evaluateFallback(const SweepOptions& options) {
  const auto robot = loadResource<RobotGeometry>("robot_model/bob.yaml");
  if (!robot) return tl::make_unexpected(robot.error());
  const auto arena = loadResource<ArenaMap>("config/arena_kitchen.yaml");
  if (!arena) return tl::make_unexpected(arena.error());
  const auto site = loadFireSite(*arena);
  if (!site) return tl::make_unexpected(site.error());

  json runs = json::array();
  std::vector<double> litres, collisions;
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    auto live = LiveSystem::start(seed, {"--start"}, {});
    if (!live) return tl::make_unexpected(live.error());
    auto person = (*live)->connectOperator("evaluation");
    if (!person) return tl::make_unexpected(person.error());
    const auto played = playByHand(**person, *robot, *arena, *site);
    person->reset();
    auto truth_text = (*live)->finish();
    if (!truth_text) return tl::make_unexpected(truth_text.error());
    const json truth = json::parse(*truth_text);
    litres.push_back(burningLitres(truth));
    collisions.push_back(static_cast<double>(truth.at("collisions").size()));
    runs.push_back({{"seed", seed},
                    {"litres_delivered", litres.back()},
                    {"collisions", truth.at("collisions")},
                    {"simulated_s", truth.at("simulated_s")},
                    {"note", played ? "" : played.error().message}});
  }
  EvaluationResult out;
  out.name = "fallback";
  out.figures = {{"litres_delivered", median(litres), "l", "", true},
                 {"collisions_total", std::accumulate(collisions.begin(), collisions.end(), 0.0),
                  "", "", true}};
  out.runs_json = runs.dump();
  out.notes = fmt::format(
      "{} runs; a scripted operator drives, aims and sprays by held commands over the operator "
      "link.",
      litres.size());
  return out;
}

}  // namespace kiln
