#include "robot/planning/arm_motion/joint_trajectory.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

constexpr int kStraightSamples = 100;
// Part of the joint acceleration for the bend of the path; the rest is for speeding up along it.
constexpr double kBendShare = 0.4;

std::vector<Vector6d> tangents(const JointPath& path) {
  const std::size_t n = path.s.size();
  std::vector<Vector6d> out(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t a = k == 0 ? 0 : k - 1;
    const std::size_t b = std::min(k + 1, n - 1);
    const double ds = path.s[b] - path.s[a];
    out[k] = ds > 0.0 ? Vector6d((path.q[b] - path.q[a]) / ds) : Vector6d::Zero();
  }
  return out;
}

std::vector<PathTiming::Sample> timingSamples(const JointPath& path,
                                              const std::vector<Vector6d>& tangent,
                                              const JointPathLimits& limits) {
  const std::size_t n = path.s.size();
  std::vector<PathTiming::Sample> out(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t a = k == 0 ? 0 : k - 1;
    const std::size_t b = std::min(k + 1, n - 1);
    const double ds = std::max(path.s[b] - path.s[a], 1e-9);
    const Vector6d bend = (tangent[b] - tangent[a]).cwiseAbs() / ds;
    out[k] = {path.s[k], limits.path_speed, limits.path_accel};
    for (int i = 0; i < 6; ++i) {
      const double slope = std::abs(tangent[k][i]);
      const double bend_accel = kBendShare * limits.accel[i];
      if (slope > 1e-9) {
        out[k].max_speed = std::min(out[k].max_speed, limits.speed[i] / slope);
        out[k].max_accel = std::min(out[k].max_accel, (1.0 - kBendShare) * limits.accel[i] / slope);
      }
      if (bend[i] > 1e-9) {
        out[k].max_speed = std::min(out[k].max_speed, std::sqrt(bend_accel / bend[i]));
      }
    }
  }
  return out;
}

}  // namespace

JointPath straightJointPath(const Vector6d& q_from, const Vector6d& q_to) {
  JointPath path;
  const double length = (q_to - q_from).cwiseAbs().maxCoeff();
  for (int k = 0; k <= kStraightSamples; ++k) {
    const double part = static_cast<double>(k) / kStraightSamples;
    path.s.push_back(part * length);
    path.q.push_back(q_from + part * (q_to - q_from));
  }
  path.q.back() = q_to;
  return path;
}

JointPathLimits slowedTo(const JointPath& path, JointPathLimits limits, double duration_s) {
  const auto lasts = [&](double path_speed) {
    JointPathLimits tried = limits;
    tried.path_speed = path_speed;
    return JointTrajectory({path}, tried).duration();
  };
  const double length = path.s.back() - path.s.front();
  if (length <= 0.0 || lasts(limits.path_speed) >= duration_s) return limits;
  // At the mean speed the ramps make it last longer than wanted, and the slower, the longer.
  double slow = length / duration_s, fast = limits.path_speed;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::min(0.5 * (slow + fast), 2.0 * slow);  // no limit is 1e6
    (lasts(middle) > duration_s ? slow : fast) = middle;
  }
  limits.path_speed = fast;
  return limits;
}

JointTrajectory::JointTrajectory(std::vector<JointPath> paths, const JointPathLimits& limits) {
  for (JointPath& path : paths) {
    Piece piece;
    piece.tangent = tangents(path);
    piece.timing = PathTiming(timingSamples(path, piece.tangent, limits), limits.jerk_time_s);
    piece.path = std::move(path);
    piece.start_s = duration_;
    duration_ += piece.timing.duration();
    pieces_.push_back(std::move(piece));
  }
}

/// Cubic Hermite between samples: position and velocity are continuous.
JointTrajectory::Point JointTrajectory::along(const Piece& piece, const PathPoint& at) {
  const auto& s = piece.path.s;
  const auto after = std::upper_bound(s.begin(), s.end(), at.s);
  const auto k = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - s.begin(), 1, static_cast<std::ptrdiff_t>(s.size()) - 1));
  const double h = s[k] - s[k - 1];
  const Vector6d &q0 = piece.path.q[k - 1], &q1 = piece.path.q[k];
  if (h <= 0.0) return {q1, Vector6d::Zero()};
  const Vector6d m0 = piece.tangent[k - 1] * h, m1 = piece.tangent[k] * h;
  const double u = std::clamp((at.s - s[k - 1]) / h, 0.0, 1.0);
  const Vector6d d = q1 - q0;
  const Vector6d c2 = 3.0 * d - 2.0 * m0 - m1, c3 = m0 + m1 - 2.0 * d;
  const Vector6d slope = (m0 + u * (2.0 * c2 + 3.0 * u * c3)) / h;
  return {q0 + u * (m0 + u * (c2 + u * c3)), slope * at.speed};
}

double JointTrajectory::covered(double t_s) const {
  double all = 0.0, done = 0.0;
  for (const Piece& piece : pieces_) {
    all += piece.path.s.back();
    done += piece.timing.at(t_s - piece.start_s).s;
  }
  return all > 0.0 ? std::clamp(done / all, 0.0, 1.0) : 1.0;
}

JointTrajectory::Point JointTrajectory::at(double t_s) const {
  const Piece* piece = &pieces_.front();
  for (const Piece& candidate : pieces_) {
    if (candidate.start_s <= t_s) piece = &candidate;
  }
  return along(*piece, piece->timing.at(t_s - piece->start_s));
}

}  // namespace kiln
