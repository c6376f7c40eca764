#include "robot/perception/calibration/lidar_calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_set>

#include <Eigen/Eigenvalues>
#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include "common/core/units.h"
#include "robot/perception/calibration/mounting.h"

namespace kiln {
namespace {

constexpr int kRings = 16;

/// One point as it was measured, and the posture it was measured from.
struct Measured {
  Eigen::Vector3d p_lidar;
  int ring = 0;
  int posture = 0;
};

/// A flat piece: the points on it and the plane n p = d in base.
struct Patch {
  std::vector<const Measured*> points;
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ(), u, v, centre;
  std::array<double, 3> bend{};  ///< unknowns: tilt along u and v, shift along n
};

struct Unknowns {
  std::array<double, 6> mount{};  ///< rotation vector and shift in lidar axes
  std::array<double, kRings> bias_m{};
};

/// Distance of a point to its plane, in sigmas.
struct PointToPlane {
  const Measured& m;
  const Patch& patch;
  Eigen::Isometry3d X_base_lidar;  ///< with the nominal mounting
  double sigma_m;

  template <class T>
  bool operator()(const T* mount, const T* bias, const T* bend, T* residual) const {
    const double range = m.p_lidar.norm();
    const T scale = (range - bias[0]) / range;
    const T p[3] = {scale * m.p_lidar.x(), scale * m.p_lidar.y(), scale * m.p_lidar.z()};
    T turned[3];
    ceres::AngleAxisRotatePoint(mount, p, turned);
    const Eigen::Matrix<T, 3, 1> moved(turned[0] + mount[3], turned[1] + mount[4],
                                       turned[2] + mount[5]);
    const Eigen::Matrix<T, 3, 1> p_base =
        X_base_lidar.linear().cast<T>() * moved + X_base_lidar.translation().cast<T>();
    const Eigen::Matrix<T, 3, 1> from = p_base - patch.centre.cast<T>();
    const Eigen::Matrix<T, 3, 1> n =
        (patch.n.cast<T>() + bend[0] * patch.u.cast<T>() + bend[1] * patch.v.cast<T>())
            .normalized();
    residual[0] = (n.dot(from) - bend[2]) / sigma_m;
    return true;
  }
};

using Cell = std::array<int, 3>;

std::vector<Measured> gather(std::span<const StillScan> scans, double max_range_m, double thin_m) {
  std::vector<Measured> out;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const PointCloud& scan = *scans[k].scan_lidar;
    std::set<Cell> taken;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Eigen::Vector3d p(scan.x[i], scan.y[i], scan.z[i]);
      const double range = p.norm();
      if (!(range > 0.3 && range < max_range_m) || scan.ring[i] >= kRings) continue;
      const Cell cell = {static_cast<int>(std::floor(p.x() / thin_m)),
                         static_cast<int>(std::floor(p.y() / thin_m)),
                         static_cast<int>(std::floor(p.z() / thin_m))};
      if (taken.insert(cell).second) out.push_back({p, scan.ring[i], static_cast<int>(k)});
    }
  }
  return out;
}

/// rms of all points to their patches' planes as they stand.
double rmsOf(const std::vector<Patch>& patches, std::span<const StillScan> scans,
             const Eigen::Isometry3d& X_flange_lidar, const Unknowns& unknowns) {
  double sum = 0.0, count = 0.0;
  const Eigen::Isometry3d X = X_flange_lidar * mountingError(unknowns.mount.data());
  for (const Patch& patch : patches) {
    // Against the best plane for this mounting, not against the one of the estimate.
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> points;
    for (const Measured* m : patch.points) {
      const double range = m->p_lidar.norm();
      const double scale = (range - unknowns.bias_m[static_cast<std::size_t>(m->ring)]) / range;
      points.push_back(scans[static_cast<std::size_t>(m->posture)].X_base_flange * X *
                       Eigen::Vector3d(scale * m->p_lidar));
      mean += points.back();
    }
    mean /= static_cast<double>(points.size());
    Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : points) C += (p - mean) * (p - mean).transpose();
    sum += std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C).eigenvalues()[0]);
    count += static_cast<double>(points.size());
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace

void LidarCalibrator::Config::visit(ConfigArchive& a) {
  a.field("cell_m", cell_m, "m", 0.1, 2, "in which a flat piece is looked for");
  a.field("max_range_m", max_range_m, "m", 1, 50, "farther points are left out");
  a.field("thin_m", thin_m, "m", 0.01, 0.5, "a point a cube and scan");
  a.field("flat_m", flat_m, "m", 0.005, 0.1, "rms of a piece that counts as flat");
  a.field("wide_m", wide_m, "m", 0.01, 1, "its extent along both axes, rms");
  a.field("min_points", min_points, "", 6, 1000, "of a piece");
  a.field("min_postures", min_postures, "", 2, 100, "from which a piece must have been seen");
  a.field("rounds", rounds, "", 1, 20, "of finding planes and solving");
  a.field("noise_m", noise_m, "m", 0.001, 0.1, "one sigma of a range");
  a.field("bias_sigma_m", bias_sigma_m, "m", 0.0001, 0.1, "prior of a laser's range bias");
  a.field("prior_m", prior_m, "m", 0.001, 1, "prior of the mounting");
  a.field("prior_deg", prior_deg, "deg", 0.1, 45, "prior of the mounting");
}

namespace {

/// Flat pieces of what all postures saw together.
std::vector<Patch> findPatches(const LidarCalibrator::Config& config,
                               const std::vector<Measured>& points,
                               std::span<const StillScan> scans,
                               const Eigen::Isometry3d& X_flange_lidar, const Unknowns& unknowns,
                               double flat_m) {
  const Eigen::Isometry3d X = X_flange_lidar * mountingError(unknowns.mount.data());
  std::map<Cell, std::vector<std::pair<const Measured*, Eigen::Vector3d>>> cells;
  for (const Measured& m : points) {
    const double range = m.p_lidar.norm();
    const double scale = (range - unknowns.bias_m[static_cast<std::size_t>(m.ring)]) / range;
    const Eigen::Vector3d p = scans[static_cast<std::size_t>(m.posture)].X_base_flange * X *
                              Eigen::Vector3d(scale * m.p_lidar);
    // Cells do not begin on whole metres, where a room's walls may stand.
    const Eigen::Vector3d shifted =
        (p + Eigen::Vector3d::Constant(0.37 * config.cell_m)) / config.cell_m;
    cells[{static_cast<int>(std::floor(shifted.x())), static_cast<int>(std::floor(shifted.y())),
           static_cast<int>(std::floor(shifted.z()))}]
        .emplace_back(&m, p);
  }
  std::vector<Patch> out;
  for (auto& [cell, members] : cells) {
    if (members.size() < static_cast<std::size_t>(config.min_points)) continue;
    Patch patch;
    std::set<int> postures;
    patch.centre.setZero();
    for (const auto& [m, p] : members) {
      patch.centre += p;
      postures.insert(m->posture);
      patch.points.push_back(m);
    }
    if (postures.size() < static_cast<std::size_t>(config.min_postures)) continue;
    patch.centre /= static_cast<double>(members.size());
    Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
    for (const auto& [m, p] : members) C += (p - patch.centre) * (p - patch.centre).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(C /
                                                              static_cast<double>(members.size()));
    if (std::sqrt(std::max(0.0, axes.eigenvalues()[0])) > flat_m ||
        std::sqrt(axes.eigenvalues()[1]) < config.wide_m)
      continue;
    patch.n = axes.eigenvectors().col(0);
    patch.u = axes.eigenvectors().col(1);
    patch.v = axes.eigenvectors().col(2);
    out.push_back(std::move(patch));
  }
  return out;
}

/// Smallest eigenvalue of the normals' spread by that of an even one: 0 when a direction is
/// missing.
double spreadOfNormals(const std::vector<Patch>& patches) {
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  for (const Patch& patch : patches) C += patch.n * patch.n.transpose();
  const double count = std::max<double>(1.0, static_cast<double>(patches.size()));
  return 3.0 * Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C / count).eigenvalues()[0];
}

std::vector<Eigen::Isometry3d> flangePoses(std::span<const StillScan> scans) {
  std::vector<Eigen::Isometry3d> out;
  for (const StillScan& scan : scans) out.push_back(scan.X_base_flange);
  return out;
}

void addResiduals(const LidarCalibrator::Config& config, std::vector<Patch>& patches,
                  std::span<const StillScan> scans, const Eigen::Isometry3d& X_flange_lidar,
                  Unknowns& unknowns, ceres::Problem& problem) {
  for (Patch& patch : patches) {
    for (const Measured* m : patch.points) {
      const StillScan& scan = scans[static_cast<std::size_t>(m->posture)];
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<PointToPlane, 1, 6, 1, 3>(
              new PointToPlane{*m, patch, scan.X_base_flange * X_flange_lidar, config.noise_m}),
          new ceres::CauchyLoss(2.0), unknowns.mount.data(),
          &unknowns.bias_m[static_cast<std::size_t>(m->ring)], patch.bend.data());
    }
  }
  const double t = config.prior_m, r = config.prior_deg * kDeg;
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<Prior<6>, 6, 6>(new Prior<6>{{r, r, r, t, t, t}}), nullptr,
      unknowns.mount.data());
  for (double& bias : unknowns.bias_m)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Prior<1>, 1, 1>(new Prior<1>{{config.bias_sigma_m}}),
        nullptr, &bias);
}

/// Planes are eliminated first: what is left is small and dense.
Result<void> solve(std::vector<Patch>& patches, Unknowns& unknowns, ceres::Problem& problem) {
  auto* order = new ceres::ParameterBlockOrdering;
  for (Patch& patch : patches) order->AddElementToGroup(patch.bend.data(), 0);
  order->AddElementToGroup(unknowns.mount.data(), 1);
  for (double& bias : unknowns.bias_m) order->AddElementToGroup(&bias, 1);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering.reset(order);
  options.max_num_iterations = 30;
  options.num_threads = 1;  // the same answer each time
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.IsSolutionUsable()) return {};
  return makeError(ErrorCode::Degenerate, "the LiDAR's mounting did not converge: {}",
                   summary.BriefReport());
}

Result<void> enoughScans(std::span<const StillScan> scans) {
  constexpr std::size_t kFewest = 6;
  constexpr double kLeastTurn = 10.0 * kDeg;
  if (scans.size() < kFewest)
    return makeError(ErrorCode::Degenerate,
                     "{} scans are too few for the LiDAR's mounting; {} at least", scans.size(),
                     kFewest);
  if (secondTurn(flangePoses(scans)) < kLeastTurn)
    return makeError(ErrorCode::Degenerate,
                     "the flange was turned about one axis only; the LiDAR's mounting needs two");
  return {};
}

}  // namespace

Result<LidarCalibration> LidarCalibrator::calibrate(std::span<const StillScan> scans,
                                                    const Eigen::Isometry3d& X_flange_lidar) const {
  constexpr std::size_t kFewestPatches = 12;
  constexpr double kLeastSpread = 0.05;
  if (auto enough = enoughScans(scans); !enough) return tl::make_unexpected(enough.error());
  const std::vector<Measured> points = gather(scans, config_.max_range_m, config_.thin_m);
  Unknowns unknowns;
  LidarCalibration out;
  Extrinsics& found = out.flange_lidar;
  std::vector<Patch> patches;
  for (int round = 0; round < config_.rounds; ++round) {
    const double share =
        std::min(1.0, static_cast<double>(round) / std::max(1, config_.rounds - 2));
    patches = findPatches(config_, points, scans, X_flange_lidar, unknowns,
                          config_.flat_m * (3.0 - 2.0 * share));
    if (patches.size() < kFewestPatches || spreadOfNormals(patches) < kLeastSpread)
      return makeError(ErrorCode::Degenerate,
                       "{} flat pieces in too few directions; the LiDAR's mounting needs floor and "
                       "walls in view",
                       patches.size());
    ceres::Problem problem;
    addResiduals(config_, patches, scans, X_flange_lidar, unknowns, problem);
    if (auto solved = solve(patches, unknowns, problem); !solved)
      return tl::make_unexpected(solved.error());
    if (round + 1 == config_.rounds) takeSigmas(problem, unknowns.mount.data(), found);
  }
  found.X_parent_sensor = X_flange_lidar * mountingError(unknowns.mount.data());
  found.rms_before = rmsOf(patches, scans, X_flange_lidar, {});
  found.rms_after = rmsOf(patches, scans, X_flange_lidar, unknowns);
  found.unit = "m";
  found.views = static_cast<int>(scans.size());
  for (const Patch& patch : patches) found.measurements += static_cast<int>(patch.points.size());
  out.range_bias_m = unknowns.bias_m;
  out.patches = static_cast<int>(patches.size());
  return out;
}

}  // namespace kiln
