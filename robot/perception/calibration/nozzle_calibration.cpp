#include "robot/perception/calibration/nozzle_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <ceres/ceres.h>

#include "common/core/units.h"
#include "common/geom/camera_model.h"
#include "common/geom/pose.h"
#include "robot/perception/calibration/mounting.h"

namespace kiln {
namespace {

constexpr double kLeastDistances_m = 0.15, kLeastRoll = 30.0 * kDeg;

/// Everything unknown, about what is believed beforehand.
struct Unknowns {
  std::array<double, 6> nozzle{}, thermal{};
  std::array<double, 3> board{};  ///< two tilts, rad; offset along the normal, m
  std::array<double, 1> flow{};   ///< relative
};

struct Scene {
  CameraModel camera;
  Eigen::Isometry3d X_flange_nozzle, X_flange_thermal;
  BoardPlane board;
  const JetPath& jet;

  [[nodiscard]] BoardPlane tilted(const double* x) const {
    const Eigen::Vector3d side = board.normal.unitOrthogonal(), other = board.normal.cross(side);
    BoardPlane out = board;
    out.normal = (board.normal + x[0] * side + x[1] * other).normalized();
    out.p += x[2] * board.normal;
    return out;
  }
  /// Expected image of the place where the jet's centre meets the board.
  [[nodiscard]] std::optional<Eigen::Vector2d> image(const LandedJet& seen, const double* nozzle,
                                                     const double* thermal, const double* plane,
                                                     const double* flow) const {
    const Eigen::Isometry3d X_base_nozzle =
        seen.X_base_flange * X_flange_nozzle * mountingError(nozzle);
    const auto p = meeting(X_base_nozzle, tilted(plane), seen.flow_scale * (1.0 + flow[0]));
    if (!p) return std::nullopt;
    return camera.project(
        (seen.X_base_flange * X_flange_thermal * mountingError(thermal)).inverse() * *p);
  }
  /// By secant: the jet is nearly straight.
  [[nodiscard]] std::optional<Eigen::Vector3d> meeting(const Eigen::Isometry3d& X_base_nozzle,
                                                       const BoardPlane& plane,
                                                       double flow_scale) const {
    if (!(flow_scale > 0.1)) return std::nullopt;
    const auto height = [&](double d) {
      return plane.normal.dot(jet(X_base_nozzle, d, flow_scale) - plane.p);
    };
    double a = 0.3, b = 0.8, at_a = height(a), at_b = height(b);
    for (int i = 0; i < 12 && std::abs(at_b) > 1e-9; ++i) {
      if (std::abs(at_b - at_a) < 1e-12) return std::nullopt;
      const double c = std::clamp(b - at_b * (b - a) / (at_b - at_a), 0.02, 3.0);
      a = std::exchange(b, c);
      at_a = std::exchange(at_b, height(c));
    }
    if (!(std::abs(at_b) < 1e-4)) return std::nullopt;
    return jet(X_base_nozzle, b, flow_scale);
  }
};

struct Reprojection {
  const Scene& scene;
  const LandedJet& seen;
  double sigma_px;
  bool operator()(const double* nozzle, const double* thermal, const double* board,
                  const double* flow, double* residual) const {
    const auto expected = scene.image(seen, nozzle, thermal, board, flow);
    if (!expected) return false;
    residual[0] = (expected->x() - seen.centre_px.x()) / sigma_px;
    residual[1] = (expected->y() - seen.centre_px.y()) / sigma_px;
    return true;
  }
};

double rmsOf(const Scene& scene, std::span<const LandedJet> landed, const Unknowns& x) {
  double sum = 0.0;
  for (const LandedJet& seen : landed) {
    const auto expected =
        scene.image(seen, x.nozzle.data(), x.thermal.data(), x.board.data(), x.flow.data());
    if (expected) sum += (*expected - seen.centre_px).squaredNorm();
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(landed.size())));
}

Result<void> enough(const Scene& scene, std::span<const LandedJet> landed, int min_spots) {
  if (landed.size() < static_cast<std::size_t>(std::max(1, min_spots)))
    return makeError(ErrorCode::Degenerate,
                     "water was seen on the board from {} postures; {} are needed: are the pumps "
                     "primed, and is the board warm?",
                     landed.size(), min_spots);
  double near = 1e9, far = 0.0, turned = 0.0;
  const auto down = [](const Eigen::Isometry3d& X_base_nozzle) {
    const Eigen::Vector3d d = X_base_nozzle.linear().transpose() * -Eigen::Vector3d::UnitZ();
    return Eigen::Vector2d(d.y(), d.z()).normalized();
  };
  const Eigen::Vector2d first = down(landed.front().X_base_flange * scene.X_flange_nozzle);
  for (const LandedJet& seen : landed) {
    const Eigen::Isometry3d X = seen.X_base_flange * scene.X_flange_nozzle;
    if (!isFinite(X) || !seen.centre_px.allFinite() || !(seen.flow_scale > 0.1))
      return makeError(ErrorCode::InvalidInput, "a wet spot has no number for its place or flow");
    const auto p = scene.meeting(X, scene.board, seen.flow_scale);
    if (!p)
      return makeError(ErrorCode::Degenerate, "the jet does not reach the board from a posture");
    near = std::min(near, (*p - X.translation()).norm());
    far = std::max(far, (*p - X.translation()).norm());
    turned = std::max(turned, std::acos(std::clamp(first.dot(down(X)), -1.0, 1.0)));
  }
  if (far - near < kLeastDistances_m)
    return makeError(ErrorCode::Degenerate,
                     "all postures were {:.2f} m from the board; direction and place of the nozzle "
                     "need distances that differ by {:.2f} m",
                     near, kLeastDistances_m);
  if (turned < kLeastRoll)
    return makeError(ErrorCode::Degenerate,
                     "the head was not rolled about the jet; a tilted nozzle and a slow jet look "
                     "alike");
  return {};
}

void addPriors(ceres::Problem& problem, Unknowns& x, const NozzleCalibrator::Config& c,
               const Extrinsics& thermal) {
  const double r = c.prior_deg * kDeg, t = c.prior_m, tilt = c.board_prior_deg * kDeg;
  const auto add = [&]<int N>(const std::array<double, N>& sigma, std::array<double, N>& values) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior<N>, N, N>(new Prior<N>{sigma}),
                             nullptr, values.data());
  };
  const auto least = [](double sigma, double floor) { return std::max(sigma, floor); };
  const Eigen::Vector3d &a = thermal.sigma_rad, &m = thermal.sigma_m;
  add.operator()<6>({r, r, r, t, t, t}, x.nozzle);
  add.operator()<6>({least(a.x(), 1e-5), least(a.y(), 1e-5), least(a.z(), 1e-5), least(m.x(), 1e-5),
                     least(m.y(), 1e-5), least(m.z(), 1e-5)},
                    x.thermal);
  add.operator()<3>({tilt, tilt, c.board_prior_m}, x.board);
  add.operator()<1>({c.flow_prior}, x.flow);
}

NozzleCalibration gathered(ceres::Problem& problem, const Unknowns& x) {
  NozzleCalibration out;
  out.flow = 1.0 + x.flow[0];
  takeSigmas(problem, x.nozzle.data(), out.flange_nozzle);
  ceres::Covariance covariance{ceres::Covariance::Options()};
  const double* flow = x.flow.data();
  const std::vector<std::pair<const double*, const double*>> wanted{{flow, flow}};
  if (!covariance.Compute(wanted, &problem)) return out;
  double variance = 0.0;
  covariance.GetCovarianceBlock(flow, flow, &variance);
  out.flow_sigma = std::sqrt(variance);
  return out;
}

}  // namespace

void NozzleCalibrator::Config::visit(ConfigArchive& a) {
  a.field("hfov_deg", hfov_deg, "deg", 10, 150, "horizontal field of view of the thermal camera");
  a.field("noise_px", noise_px, "px", 0.01, 5, "one sigma of a wet spot's centre");
  a.field("prior_m", prior_m, "m", 0.0001, 1, "prior of the mounting");
  a.field("prior_deg", prior_deg, "deg", 0.01, 45, "prior of the mounting");
  a.field("flow_prior", flow_prior, "", 0.001, 1, "prior of the pumps' flow, relative");
  a.field("board_prior_m", board_prior_m, "m", 0.0001, 1, "prior of the board's distance");
  a.field("board_prior_deg", board_prior_deg, "deg", 0.001, 10, "prior of the board's tilt");
  a.field("min_spots", min_spots, "", 4, 1000, "fewer are refused");
}

Result<NozzleCalibration> NozzleCalibrator::calibrate(std::span<const LandedJet> landed,
                                                      const Eigen::Isometry3d& X_flange_nozzle,
                                                      const Extrinsics& flange_thermal,
                                                      const BoardPlane& board,
                                                      const JetPath& jet) const {
  const Scene scene{CameraModel::fromHorizontalFov(160, 120, config_.hfov_deg * kDeg),
                    X_flange_nozzle, flange_thermal.X_parent_sensor, board, jet};
  if (auto ok = enough(scene, landed, config_.min_spots); !ok)
    return tl::make_unexpected(ok.error());
  Unknowns x;
  ceres::Problem problem;
  for (const LandedJet& seen : landed) {
    problem.AddResidualBlock(
        new ceres::NumericDiffCostFunction<Reprojection, ceres::CENTRAL, 2, 6, 6, 3, 1>(
            new Reprojection{scene, seen, config_.noise_px}),
        new ceres::CauchyLoss(3.0), x.nozzle.data(), x.thermal.data(), x.board.data(),
        x.flow.data());
  }
  addPriors(problem, x, config_, flange_thermal);
  const double before = rmsOf(scene, landed, x);
  if (auto solved = solveMounting(problem, "nozzle"); !solved)
    return tl::make_unexpected(solved.error());
  NozzleCalibration out = gathered(problem, x);
  out.flange_nozzle.X_parent_sensor = X_flange_nozzle * mountingError(x.nozzle.data());
  out.flange_nozzle.rms_before = before;
  out.flange_nozzle.rms_after = rmsOf(scene, landed, x);
  out.flange_nozzle.unit = "px";
  out.flange_nozzle.views = out.flange_nozzle.measurements = static_cast<int>(landed.size());
  return out;
}

}  // namespace kiln
