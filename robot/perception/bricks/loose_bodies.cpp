#include "robot/perception/bricks/loose_bodies.h"

#include <algorithm>

#include "robot/perception/bricks/point_clusters.h"

namespace kiln {
namespace {

constexpr double kBesideBrick_m = 0.05;  // nearer to a brick: its noise, its edges
constexpr double kGap_m = 0.05;
constexpr std::size_t kMinPoints = 40;
constexpr double kSpare_m = 0.12;  // noise and a tilt make a body longer than its brick

}  // namespace

std::vector<LooseBody> looseBodies(const PreparedSweep& sweep, std::span<const int> owners,
                                   std::span<const ModelBrick> bricks) {
  std::vector<Eigen::Isometry3f> inverse;
  std::vector<Eigen::Array3f> limit;
  for (const ModelBrick& brick : bricks) {
    inverse.push_back(brick.X_world_brick.inverse().cast<float>());
    limit.emplace_back((0.5 * brickSize(brick.kind).array() + kBesideBrick_m).cast<float>());
  }
  std::vector<Eigen::Vector3f> loose;
  for (std::size_t i = 0; i < sweep.surface.size(); ++i) {
    if (owners[i] >= 0) continue;
    bool beside = false;
    for (std::size_t b = 0; b < bricks.size() && !beside; ++b)
      beside = ((inverse[b] * sweep.surface[i].p).array().abs() < limit[b]).all();
    if (!beside) loose.push_back(sweep.surface[i].p);
  }
  std::vector<LooseBody> out;
  for (const auto& cluster : clusterPoints(loose, kGap_m)) {
    if (cluster.size() < kMinPoints) continue;
    std::vector<Eigen::Vector3f> points;
    for (const std::size_t i : cluster) points.push_back(loose[i]);
    const GroundOutline outline = outlineOf(points);
    LooseBody body;
    body.centre = {outline.centre.x(), outline.centre.y(), 0.5 * (outline.low_m + outline.high_m)};
    body.yaw_rad = outline.yaw_rad;
    body.length_m = outline.length_m;
    body.width_m = outline.width_m;
    body.height_m = outline.high_m;
    body.points = static_cast<int>(cluster.size());
    out.push_back(body);
  }
  return out;
}

bool mayBe(const LooseBody& body, BrickKind kind) {
  const double length = brickShape(kind).length_m;
  const double diagonal = std::hypot(length, kBrickSide_m);
  return body.length_m > 0.5 * length && body.length_m < diagonal + kSpare_m &&
         body.height_m < std::max(length, 1.5 * kBrickSide_m) + kSpare_m;
}

}  // namespace kiln
