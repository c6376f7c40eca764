#include "robot/localization/mapping/map_anchor.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "common/core/units.h"
#include "robot/localization/box_map_aligner.h"

namespace kiln {
namespace {

constexpr double kUpright = 0.9;       // Z of a floor surfel's normal
constexpr double kFloorBelow_m = 0.4;  // above the lowest tenth: table tops and counters
constexpr double kFloorGate_m = 0.05;  // of the fit
constexpr int kMinFloorSurfels = 30;
constexpr int kMinWallFixes = 3;
constexpr double kMinWallInliers = 0.45;
constexpr int kRounds = 3;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Bounds of the walls, 0.3 m inside, X and Y.
struct Interior {
  double x_min = 1e9, x_max = -1e9, y_min = 1e9, y_max = -1e9;
  explicit Interior(const ArenaMap& arena) {
    for (const WallSegment& face : wallSegments(arena.walls)) {
      for (const Eigen::Vector2d& p :
           {face.start, Eigen::Vector2d(face.start + face.length_m * face.direction)}) {
        x_min = std::min(x_min, p.x() + 0.5);
        x_max = std::max(x_max, p.x() - 0.5);
        y_min = std::min(y_min, p.y() + 0.5);
        y_max = std::max(y_max, p.y() - 0.5);
      }
    }
  }
  [[nodiscard]] bool contains(double x, double y) const {
    return x > x_min && x < x_max && y > y_min && y < y_max;
  }
};

/// X_level_map: the floor inside the building becomes z = 0.
Result<Eigen::Isometry3d> level(const SurfelMap& map, const Interior& inside, MapAnchor& anchor) {
  std::vector<Eigen::Vector3d> floor;
  std::vector<double> heights;
  for (const Surfel& surfel : map.surfels(0)) {
    const Eigen::Vector3d p = surfel.mean.cast<double>();
    if (static_cast<double>(surfel.normal.z()) < kUpright || !inside.contains(p.x(), p.y()))
      continue;
    floor.push_back(p);
    heights.push_back(p.z());
  }
  if (static_cast<int>(floor.size()) < kMinFloorSurfels) {
    return makeError(ErrorCode::Degenerate,
                     "the map shows {} pieces of floor inside the building, {} are needed; drive a "
                     "round inside",
                     floor.size(), kMinFloorSurfels);
  }
  std::sort(heights.begin(), heights.end());
  const double low = heights[heights.size() / 10];
  Eigen::Vector3d plane(0, 0, 0);  // z = a x + b y + c
  for (int round = 0; round < 5; ++round) {
    Eigen::Matrix3d H = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    double squares = 0.0;
    int used = 0;
    for (const Eigen::Vector3d& p : floor) {
      const Eigen::Vector3d row(p.x(), p.y(), 1.0);
      const double error = p.z() - row.dot(plane);
      if (round == 0 ? std::abs(p.z() - low) > kFloorBelow_m
                     : std::abs(error) > (round == 1 ? 2.0 : 1.0) * kFloorGate_m) {
        continue;
      }
      H += row * row.transpose();
      g += row * p.z();
      squares += error * error;
      ++used;
    }
    plane = H.ldlt().solve(g);
    anchor.floor_rms_m = std::sqrt(squares / std::max(1, used));
    anchor.floor_surfels = used;
  }
  if (anchor.floor_surfels < kMinFloorSurfels)
    return makeError(ErrorCode::Degenerate, "the floor inside the building is not a plane");
  const Eigen::Vector3d normal = Eigen::Vector3d(-plane.x(), -plane.y(), 1.0).normalized();
  Eigen::Isometry3d X_level_map = Eigen::Isometry3d::Identity();
  X_level_map.linear() =
      Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_level_map.translation().z() = -(X_level_map.linear() * Eigen::Vector3d(0, 0, plane.z())).z();
  return X_level_map;
}

/// The scan as if the base stood level on z = 0, under it.
PointCloud levelled(const Keyframe& keyframe, const Eigen::Isometry3d& X_level_base) {
  const Keyframe& k = keyframe;
  PointCloud out;
  out.stamp = k.scan_base.stamp;
  out.frame = k.scan_base.frame;
  for (std::size_t i = 0; i < k.scan_base.size(); ++i) {
    const Eigen::Vector3d p =
        X_level_base *
        Eigen::Vector3f(k.scan_base.x[i], k.scan_base.y[i], k.scan_base.z[i]).cast<double>();
    out.push(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0, 0,
             0.0F);
  }
  return out;
}

struct WallFix {
  Pose2 mapped, aligned;
};

std::vector<WallFix> wallFixes(std::span<const Keyframe> keyframes,
                               std::span<const Eigen::Isometry3d> poses,
                               const Eigen::Isometry3d& X_arena_map, const Interior& inside,
                               const BoxMapAligner& aligner, bool wide) {
  std::vector<WallFix> fixes;
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Eigen::Isometry3d X = X_arena_map * poses[i];
    if (!inside.contains(X.translation().x(), X.translation().y())) continue;
    const Pose2 ground = projectToGround(X);
    const Eigen::Isometry3d X_level_base = toIsometry(ground).inverse() * X;
    const PointCloud scan = levelled(keyframes[i], X_level_base);
    const Eigen::Vector3d p_level_sensor = X_level_base * keyframes[i].p_base_sensor;
    const auto found = wide ? aligner.search(scan, p_level_sensor, ground)
                            : aligner.align(scan, p_level_sensor, ground);
    if (!found || found->observable_directions < 3 || found->inlier_fraction < kMinWallInliers)
      continue;
    fixes.push_back({ground, found->X_map_base});
  }
  return fixes;
}

/// The planar motion that brings the mapped poses onto the aligned ones; medians, because a single
/// alignment may be caught by a cupboard.
Pose2 correction(const std::vector<WallFix>& fixes) {
  std::vector<double> x, y, yaw;
  for (const WallFix& fix : fixes)
    yaw.push_back(wrapAngle(fix.aligned.yaw_rad - fix.mapped.yaw_rad));
  const Pose2 turn{0, 0, median(yaw)};
  for (const WallFix& fix : fixes) {
    const Pose2 turned = turn * fix.mapped;
    x.push_back(fix.aligned.x_m - turned.x_m);
    y.push_back(fix.aligned.y_m - turned.y_m);
  }
  return {median(x), median(y), turn.yaw_rad};
}

}  // namespace

Result<MapAnchor> anchorMap(const SurfelMap& map, std::span<const Keyframe> keyframes,
                            std::span<const Eigen::Isometry3d> poses, const ArenaMap& arena) {
  MapAnchor out;
  const Interior inside(arena);
  const auto levelling = level(map, inside, out);
  if (!levelling) return tl::make_unexpected(levelling.error());
  out.X_arena_map = *levelling;
  const BoxMapAligner aligner({}, arena);
  std::vector<WallFix> fixes;
  for (int round = 0; round < kRounds; ++round) {
    fixes = wallFixes(keyframes, poses, out.X_arena_map, inside, aligner, round == 0);
    if (static_cast<int>(fixes.size()) < kMinWallFixes) {
      return makeError(ErrorCode::Degenerate,
                       "only {} of {} keyframes fit the configured walls, {} are needed; check the "
                       "arena file and the start pose",
                       fixes.size(), keyframes.size(), kMinWallFixes);
    }
    if (round + 1 < kRounds) out.X_arena_map = toIsometry(correction(fixes)) * out.X_arena_map;
  }
  double metres2 = 0.0, radians2 = 0.0;
  for (const WallFix& fix : fixes) {
    metres2 += std::pow(fix.aligned.x_m - fix.mapped.x_m, 2) +
               std::pow(fix.aligned.y_m - fix.mapped.y_m, 2);
    radians2 += std::pow(wrapAngle(fix.aligned.yaw_rad - fix.mapped.yaw_rad), 2);
  }
  out.wall_fixes = static_cast<int>(fixes.size());
  out.wall_rms_m = std::sqrt(metres2 / out.wall_fixes);
  out.wall_rms_deg = std::sqrt(radians2 / out.wall_fixes) / kDeg;
  return out;
}

double wallCoverage(const SurfelMap& map, const ArenaMap& arena) {
  const Interior inside(arena);
  const Eigen::Vector2d middle(0.5 * (inside.x_min + inside.x_max),
                               0.5 * (inside.y_min + inside.y_max));
  int all = 0, seen = 0;
  SurfelMap::Neighbours near;
  for (const WallSegment& face : facing(wallSegments(arena.walls), middle)) {
    const Eigen::Vector3f normal(static_cast<float>(face.normal.x()),
                                 static_cast<float>(face.normal.y()), 0.0F);
    for (double along = 0.2; along < face.length_m - 0.1; along += 0.2) {
      const Eigen::Vector2d xy = face.start + along * face.direction;
      for (double z = std::max(0.4, face.z_min_m); z < std::min(2.2, face.z_max_m); z += 0.2) {
        const Eigen::Vector3f p(static_cast<float>(xy.x()), static_cast<float>(xy.y()),
                                static_cast<float>(z));
        map.gather(0, p, normal, near);
        ++all;
        seen +=
            std::any_of(near.surfels.begin(), near.surfels.begin() + near.size,
                        [&](const Surfel* s) { return std::abs(normal.dot(p - s->mean)) < 0.1F; })
                ? 1
                : 0;
      }
    }
  }
  return all > 0 ? static_cast<double>(seen) / all : 0.0;
}

}  // namespace kiln
