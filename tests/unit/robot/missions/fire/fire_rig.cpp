#include "tests/unit/robot/missions/fire/fire_rig.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/camera_model.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

template <class T>
T loaded(const std::string& file) {
  T out;
  const auto result = loadConfig(kiln::sourceDir() + "/resources/" + file, out);
  EXPECT_TRUE(result.has_value()) << (result ? std::string() : result.error().message);
  return out;
}

constexpr double kFramePeriod_s = 1.0 / 8.77;
constexpr double kThreshold_c = 75.0;
constexpr double kReported_c = 40.0;
constexpr double kKelvin = 273.15;

}  // namespace

void FakeHeatSweep::add(const HeatDetections& detections, const Eigen::Isometry3d&,
                        const Eigen::Vector3d&) {
  if (detections.blobs.empty() || detections.blobs[0].rejection != HeatRejection::None) return;
  ++views_;
  stamp_ = detections.stamp;
}

std::optional<FireEstimate> FakeHeatSweep::estimate() const {
  if (views_ < 5) return std::nullopt;
  FireEstimate out;
  out.stamp = stamp_;
  out.p_map = p_plate_map;
  out.covariance = Eigen::Matrix3d::Identity() * sigma_m * sigma_m;
  out.views = views_;
  out.peak_k = 380.0;
  return out;
}

void FakePlaceLook::begin(const std::string& place, const Eigen::Isometry3d& X_map_front) {
  ++asked;
  answer_.reset();
  if (silent) return;
  PlaceCheck check;
  check.stamp = clock_.now();
  check.place = place;
  check.X_map_configured = X_map_front;
  if (!first_.count(place)) first_[place] = X_map_front;
  const Pose2 at = projectToGround(first_[place]);
  check.X_map_sensed = makePose({at.x_m + misplaced.x_m, at.y_m + misplaced.y_m, 0.0},
                                {0, 0, at.yaw_rad + misplaced.yaw_rad});
  check.offset_m = std::hypot(check.correction().x_m, check.correction().y_m);
  check.verdict = check.offset_m < 0.145 ? PlaceVerdict::Fits : PlaceVerdict::Misplaced;
  check.reason = check.verdict == PlaceVerdict::Fits ? "fits" : place + " stands elsewhere";
  answer_ = check;
}

FireRig::FireRig() : FireRig(Options{}) {}

FireRig::FireRig(const Options& options)
    : robot(loaded<RobotGeometry>("robot_model/bob.yaml")),
      arm_device(clock, robot, RobotGeometry::radians(robot.q_park_deg)),
      pumps_device(clock),
      arm(robot, arm_device),
      base(arena.start.pose()),
      burning_place(options.burning_place),
      options_(options),
      plate_lit_(clock.now()),
      next_image_(clock.now()) {
  const int burning = std::max(0, burning_place);
  const auto plate = loadKitchenSite().places[static_cast<std::size_t>(burning)].plate_xyz_m;
  sweep.p_plate_map =
      Eigen::Vector3d(plate[0], plate[1], plate[2]) + Eigen::Vector3d(0.04, -0.06, 0.0);
  build();
  if (options.start) host->start(clock.now());
}

void FireRig::build() {
  host.reset();
  mission.reset();
  pumps = std::make_unique<PumpController>(PumpController::Config{}, pumps_device, stop);
  belief = {};
  const FireDevices devices{{clock,
                             executor_,
                             arena,
                             robot,
                             belief,
                             base,
                             arm,
                             arm_device,
                             *pumps,
                             [this] { return base.pose(); },
                             {},
                             [](Stamp) { return std::nullopt; },
                             [](Stamp) { return std::nullopt; },
                             [](const ThermalImagePtr&) {},
                             [](const MissionDetail&) {}},
                            sweep,
                            place_look,
                            loadKitchenSite(),
                            spray_calibration_};
  mission = std::make_unique<FireMission>(devices, config, "test-uuid");
  host = std::make_unique<MissionHost>(*mission, belief, stop, clock,
                                       CheckpointKeeper::Config{options_.checkpoint_path});
}

void FireRig::killAndResume() {
  base.cancel();
  arm.cancel();
  build();
  run(0.0);
  for (int i = 0; i < 50; ++i) {  // one second without a daemon: device fail-safes act
    clock.advanceBy(std::chrono::milliseconds(20));
    pumps_device.advance();
    arm_device.advance();
  }
  const auto saved = loadCheckpoint(options_.checkpoint_path);
  ASSERT_TRUE(saved.has_value()) << saved.error();
  const auto resumed = host->restore(*saved, clock.now());
  ASSERT_TRUE(resumed.has_value()) << resumed.error();
  host->resume(clock.now());
}

void FireRig::run(double seconds) {
  const Stamp until = clock.now() + fromSeconds(seconds);
  while (clock.now() < until) step();
}

bool FireRig::runUntil(const std::function<bool()>& condition, double limit_s) {
  const Stamp until = clock.now() + fromSeconds(limit_s);
  while (!condition() && clock.now() < until) step();
  return condition();
}

bool FireRig::runToState(const std::string& name, double limit_s) {
  return runUntil([this, &name] { return state() == name; }, limit_s);
}

bool FireRig::runToEnd(double limit_s) {
  return runUntil([this] { return status().terminal; }, limit_s);
}

void FireRig::step() {
  clock.advanceBy(std::chrono::milliseconds(20));
  const Stamp now = clock.now();
  arm_device.advance();
  pumps_device.advance();
  if (now >= next_image_) takeImage();
  belief.X_map_base = base.pose();
  host->tick(now);
  pumps->tick(now);
  const FsmStatus seen = status();
  if (seen.step != last_step_) visited_.push_back(seen.state);
  last_step_ = seen.step;
  if (base.moving() && !armAt(robot.q_drive_deg)) drove_extended = true;
  if (base.moving() && pumpsRun()) pumped_while_driving = true;
}

bool FireRig::plateInView(const Eigen::Isometry3d& X_map_thermal) const {
  const Eigen::Vector3d p = X_map_thermal.inverse() * sweep.p_plate_map;
  return p.z() > 0.2 && p.norm() < 2.0 && std::hypot(p.x(), p.y()) < 0.5 * p.z();
}

void FireRig::takeImage() {
  while (next_image_ <= clock.now()) next_image_ += fromSeconds(kFramePeriod_s);
  if (camera_dead) return;
  const Eigen::Isometry3d X_map_thermal = toIsometry(base.pose()) *
                                          robot.X_base_flange(arm_device.state()->q) *
                                          robot.X_flange_thermal.pose();
  HeatDetections seen;
  seen.stamp = clock.now();
  seen.image_seq = ++image_seq_;
  seen.threshold_k = kThreshold_c + kKelvin;
  seen.usable = !camera_frozen;
  if (camera_frozen) seen.refusal = "frozen";
  const double plate_c = steady_c.value_or(
      25.0 + 105.0 * (1.0 - std::exp(-toSeconds(clock.now() - plate_lit_) / 60.0)));
  if (seen.usable && burning_place >= 0 && !hidden && plate_c > kReported_c &&
      plateInView(X_map_thermal)) {
    HeatBlob& blob = seen.blobs.emplace_back();
    blob.peak_k = plate_c + kKelvin;
    if (plate_c < kThreshold_c) blob.rejection = HeatRejection::TooCool;
    const auto px = CameraModel::fromHorizontalFov(160, 120, 57.0 * kDeg)
                        .project(X_map_thermal.inverse() * sweep.p_plate_map);
    if (px) {
      blob.u = px->x();
      blob.v = px->y();
    }
  }
  mission->onDetections(seen, X_map_thermal);
}

ChangeStateResult FireRig::force(const std::string& to) {
  const FsmStatus seen = status();
  return mission->machine().changeState({seen.state, seen.step, to}, "Ada", clock.now());
}

int FireRig::countVisits(const std::string& name) const {
  return static_cast<int>(std::count(visited_.begin(), visited_.end(), name));
}

std::string FireRig::noteOf(const std::string& name) const {
  std::string note = "(never entered)";
  for (const FsmHistoryEntry& entry : status().history)
    if (entry.state == name) note = entry.note;
  return note;
}

bool FireRig::armAt(const std::vector<double>& q_deg) const {
  return (arm_device.state()->q - RobotGeometry::radians(q_deg)).cwiseAbs().maxCoeff() < 0.04;
}

bool FireRig::pumpsRun() const {
  const PumpsState state = *pumps_device.state();
  return state.duty[0] > 0.0 || state.duty[1] > 0.0;
}

}  // namespace kiln
