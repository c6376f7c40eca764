#include "robot/perception/thermal/plate_fit.h"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

namespace kiln::thermal {
namespace {

// Parameters: 0-2 position, 3 yaw of the normal, 4-6 camera rotation, 7-9 camera translation, 10
// size.
constexpr int kParameters = 11;
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Hessian = Eigen::Matrix<double, kParameters, kParameters>;
constexpr int kMaxIterations = 25;
constexpr double kStep = 1e-5;          // of the numeric derivatives: metres, radians, ratio
constexpr double kLostResidual = 20.0;  // sigmas, where the model sees no plate at all

struct Problem {
  const PlateModel& model;
  const CameraModel& camera;
  std::span<const PlateMeasurement> measurements;
  Eigen::Vector3d normal;
  const PlateFitNoise& noise;
  std::vector<Eigen::Isometry3d> X_camera_map;  ///< of each measurement

  [[nodiscard]] Eigen::Vector3d residual(std::size_t index, const Parameters& p) const {
    const PlateMeasurement& m = measurements[index];
    const Eigen::Vector3d n = Eigen::AngleAxisd(p[3], Eigen::Vector3d::UnitZ()) * normal;
    const Eigen::Vector3d w = p.segment<3>(4);
    Eigen::Isometry3d X_true_nominal =
        Eigen::Isometry3d::Identity();  // small rotation: first order is enough
    X_true_nominal.linear() = Eigen::Quaterniond(1, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z())
                                  .normalized()
                                  .toRotationMatrix();
    X_true_nominal.translation() = p.segment<3>(7);
    const Eigen::Isometry3d X_camera_plate =
        X_true_nominal * X_camera_map[index] * platePose(p.head<3>(), n);
    const auto view = viewPlate(model, camera, X_camera_plate);
    if (!view) return Eigen::Vector3d::Constant(kLostResidual);
    const double radius = std::sqrt(view->area_px / M_PI) * (1.0 + p[10]);
    Eigen::Vector3d r;
    r.head<2>() = (view->centre_px - m.seen.centre_px) / noise.centre_px;
    r[2] = (radius - std::sqrt(m.seen.area_px / M_PI)) / noise.radius_px;
    return r;
  }
  [[nodiscard]] Parameters priorSigmas() const {
    Parameters s;
    s << 1e3, 1e3, 1e3, noise.normal_yaw_rad, noise.extrinsic_rad, noise.extrinsic_rad,
        noise.extrinsic_rad, noise.extrinsic_m, noise.extrinsic_m, noise.extrinsic_m,
        noise.size_ratio;
    return s;
  }
};

struct Linearised {
  Hessian H = Hessian::Zero();
  Parameters g = Parameters::Zero();
  double cost = 0.0;
  double squares = 0.0;
};

double robustCost(double squared, double scale) {
  return scale * scale * std::log1p(squared / (scale * scale));
}

double costAt(const Problem& problem, const Parameters& p, const Parameters& p0) {
  double cost = (p - p0).cwiseQuotient(problem.priorSigmas()).squaredNorm();
  for (std::size_t m = 0; m < problem.measurements.size(); ++m) {
    cost +=
        robustCost(problem.residual(m, p).squaredNorm(), problem.noise.robust_px * std::sqrt(3.0));
  }
  return cost;
}

Linearised linearise(const Problem& problem, const Parameters& p, const Parameters& p0) {
  Linearised out;
  const Parameters sigmas = problem.priorSigmas();
  const Parameters prior = (p - p0).cwiseQuotient(sigmas);
  out.H.diagonal() = sigmas.cwiseProduct(sigmas).cwiseInverse();
  out.g = prior.cwiseQuotient(sigmas);
  out.cost = prior.squaredNorm();
  const double scale = problem.noise.robust_px * std::sqrt(3.0);
  for (std::size_t m = 0; m < problem.measurements.size(); ++m) {
    const Eigen::Vector3d r = problem.residual(m, p);
    Eigen::Matrix<double, 3, kParameters> J;
    for (int i = 0; i < kParameters; ++i) {
      Parameters moved = p;
      moved[i] += kStep;
      J.col(i) = (problem.residual(m, moved) - r) / kStep;
    }
    const double weight = 1.0 / (1.0 + r.squaredNorm() / (scale * scale));
    out.H += weight * J.transpose() * J;
    out.g += weight * J.transpose() * r;
    out.cost += robustCost(r.squaredNorm(), scale);
    out.squares += r.squaredNorm();
  }
  return out;
}

}  // namespace

PlateFit fitPlate(const PlateModel& model, const CameraModel& camera,
                  std::span<const PlateMeasurement> measurements, const Eigen::Vector3d& initial,
                  const Eigen::Vector3d& normal, const PlateFitNoise& noise) {
  Problem problem{model, camera, measurements, normal, noise, {}};
  for (const auto& m : measurements) problem.X_camera_map.push_back(m.X_map_camera.inverse());
  Parameters p0 = Parameters::Zero();
  p0.head<3>() = initial;
  Parameters p = p0;
  PlateFit fit;
  double damping = 1e-3;
  Linearised now = linearise(problem, p, p0);
  for (; fit.iterations < kMaxIterations && !fit.converged; ++fit.iterations) {
    Hessian damped = now.H;
    damped.diagonal() *= 1.0 + damping;
    const Parameters step = -damped.ldlt().solve(now.g);
    if (!step.allFinite()) break;
    if (costAt(problem, p + step, p0) < now.cost) {
      p += step;
      damping = std::max(damping * 0.2, 1e-9);
      now = linearise(problem, p, p0);
      fit.converged = step.head<3>().norm() < 2e-5;
    } else {
      fit.converged = step.head<3>().norm() < 1e-6;
      damping *= 8;
      if (damping > 1e6) break;
    }
  }
  fit.p_map = p.head<3>();
  fit.normal_yaw_offset_rad = p[3];
  fit.covariance = now.H.ldlt().solve(Hessian::Identity()).topLeftCorner<3, 3>();
  fit.rms = std::sqrt(now.squares / (3.0 * static_cast<double>(measurements.size())));
  return fit;
}

}  // namespace kiln::thermal
