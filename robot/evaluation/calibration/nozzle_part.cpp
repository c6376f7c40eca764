#include "robot/evaluation/calibration/nozzle_part.h"

#include <algorithm>
#include <cmath>

#include "common/core/log.h"
#include "common/core/units.h"
#include "robot/missions/fire/skills/jet.h"

namespace kiln {
namespace {

Result<BoardPrior> expectedBoard(const CalibrationRig& rig, const std::string& name) {
  const auto& walls = rig.yard().walls;
  const auto wall = std::find_if(walls.begin(), walls.end(),
                                 [&](const BoxConfig& box) { return box.name == name; });
  if (wall == walls.end())
    return makeError(ErrorCode::NotFound, "the yard's map has no wall '{}' to spray on", name);
  const Eigen::Isometry3d X = rig.X_base_map() * wall->center.pose();
  BoardPrior out;
  Eigen::Vector3d normal = X.linear().col(0);
  if (normal.dot(X.translation()) > 0.0) normal = -normal;
  out.where = {X.translation() + 0.5 * wall->size_m[0] * normal, normal, 0.0, 0};
  out.half_width_m = 0.5 * wall->size_m[1];
  out.half_height_m = 0.5 * wall->size_m[2];
  return out;
}

/// Switches the pumps off on every way out.
class Spraying {
 public:
  explicit Spraying(CalibrationRig& rig) : rig_(rig) { rig_.spray(true); }
  ~Spraying() { rig_.spray(false); }
  Spraying(const Spraying&) = delete;
  Spraying& operator=(const Spraying&) = delete;

 private:
  CalibrationRig& rig_;
};

class BoardSpray {
 public:
  BoardSpray(CalibrationRig& rig, const NozzlePartConfig& config, const BoardPlane& board)
      : rig_(rig), config_(config), board_(board) {}

  [[nodiscard]] Eigen::Isometry3d posture(int i) const;
  Result<void> sprayHere();
  [[nodiscard]] const std::vector<LandedJet>& landed() const { return landed_; }

 private:
  struct Pictures {
    ThermalImagePtr before, after;
    PumpTracking pumps;
  };
  Result<Pictures> spray();

  CalibrationRig& rig_;
  const NozzlePartConfig& config_;
  BoardPlane board_;
  std::vector<LandedJet> landed_;
};

/// Near and far, rolled about the jet, aslant; every spot on another part of the board.
Eigen::Isometry3d BoardSpray::posture(int i) const {
  const double distance = 0.75 + spread(i, 2, 0.3), roll = spread(i, 3, 100.0 * kDeg);
  const double bearing = spread(i, 11, 14.0 * kDeg), height = spread(i, 13, 8.0 * kDeg);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), side = up.cross(board_.normal);
  const Eigen::Vector3d target = board_.p + spread(i, 5, 0.3) * side + spread(i, 7, 0.25) * up;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() =
      target +
      distance * (board_.normal + std::tan(bearing) * side + std::tan(height) * up).normalized();
  const Eigen::Vector3d aim = target + config_.jet.dropAt(distance) * up;
  X.linear() = frameFromXAndUp(aim - X.translation(), up);
  X.rotate(Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return X * rig_.nominal().X_flange_nozzle.pose().inverse();
}

Result<BoardSpray::Pictures> BoardSpray::spray() {
  const Spraying on(rig_);
  Pictures out;
  if (auto passed = rig_.pass(config_.first_look_s); !passed)
    return tl::make_unexpected(passed.error());
  const auto before = rig_.nextImage();
  if (!before) return tl::make_unexpected(before.error());
  if (auto passed = rig_.pass(config_.spray_s); !passed) return tl::make_unexpected(passed.error());
  const auto after = rig_.nextImage();
  if (!after) return tl::make_unexpected(after.error());
  auto pumps = rig_.pumps();
  if (!pumps) return tl::make_unexpected(pumps.error());
  return Pictures{*before, *after, std::move(*pumps)};
}

Result<void> BoardSpray::sprayHere() {
  const auto X = rig_.flange();
  if (!X) return tl::make_unexpected(X.error());
  const auto pictures = spray();
  if (!pictures) return tl::make_unexpected(pictures.error());
  if (auto drained = rig_.pass(config_.drain_s); !drained) return drained;
  const auto spot = findWetSpot(*pictures->before, *pictures->after, config_.spot);
  if (!spot) {
    logger("calibrate")->info("no wet spot from a posture: {}", spot.error().message);
    return {};
  }
  const auto& tanks = pictures->pumps.tank_l_est;
  const double level = 0.5 * (tanks[0] + tanks[1]) / PumpController::Config{}.tank_l;
  landed_.push_back({*X, spot->centre_px, config_.jet.flowScale(level)});
  return {};
}

}  // namespace

Result<NozzleCalibration> calibrateNozzle(CalibrationRig& rig, const NozzleReferences& found,
                                          const NozzlePartConfig& config) {
  const auto prior = expectedBoard(rig, config.board);
  if (!prior) return tl::make_unexpected(prior.error());
  const auto board = findBoard(found.scans, found.lidar, *prior);
  if (!board) return tl::make_unexpected(board.error());
  Eigen::Isometry3d X_base_box = Eigen::Isometry3d::Identity();
  X_base_box.linear() = frameFromXAndUp(board->normal, Eigen::Vector3d::UnitZ());
  X_base_box.translation() = board->p;
  rig.placeWall(config.board, X_base_box);

  BoardSpray spray(rig, config, *board);
  const auto postures = rig.reachable(0, config.postures, [&](int i) { return spray.posture(i); });
  const auto visited = rig.visit(postures, [&] { return spray.sprayHere(); });
  if (!visited) return tl::make_unexpected(visited.error());
  logger("calibrate")
      ->info("the board stands {:.3f} m before the base, {} points, {:.1f} mm rms; {} wet spots",
             -board->normal.dot(board->p), board->points, 1e3 * board->rms_m,
             spray.landed().size());
  return NozzleCalibrator(config.calibrator)
      .calibrate(
          spray.landed(), rig.nominal().X_flange_nozzle.pose(), found.thermal.flange_thermal,
          *board,
          [&config](const Eigen::Isometry3d& X_base_nozzle, double distance_m, double flow_scale) {
            return jetPoint(config.jet, X_base_nozzle, distance_m, flow_scale);
          });
}

}  // namespace kiln
