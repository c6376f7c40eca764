#include "tests/unit/robot/perception/bricks/render_cloud.h"

#include <algorithm>
#include <cmath>

#include "common/geom/pose.h"
#include "robot/scene/pile_layout.h"
#include "robot/scene/raycaster.h"

namespace kiln {
namespace {

constexpr int kTile = 4;  // 4 x 4 pixels: one packet

/// Axes of a camera at `eye` that looks at `at`: X right, Y down, Z viewing.
Eigen::Matrix3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& at) {
  Eigen::Matrix3d R;
  R.col(2) = (at - eye).normalized();
  R.col(0) = R.col(2).cross(Eigen::Vector3d::UnitZ()).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

std::uint8_t faceOf(const ModelBrick& brick, const Eigen::Vector3f& normal) {
  const Eigen::Vector3d n = brick.X_world_brick.linear().transpose() * normal.cast<double>();
  int k = 0;
  n.cwiseAbs().maxCoeff(&k);
  return static_cast<std::uint8_t>(2 * k + (n[k] > 0.0 ? 1 : 0));
}

}  // namespace

std::vector<ModelPoint> renderCloud(const ModelWorld& world, int pixels) {
  Raycaster rays;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const ModelBrick& brick : world.bricks) {
    rays.addBox(brickSize(brick.kind), brick.X_world_brick, 0);
    middle += brick.X_world_brick.translation() / static_cast<double>(world.bricks.size());
  }
  rays.commit();
  const Eigen::Vector3d eye = world.sensors.front();
  const Eigen::Matrix3d R = lookAt(eye, middle);
  double reach = 0.0;  // tangent of the half opening angle
  for (const ModelBrick& brick : world.bricks)
    for (int c = 0; c < 8; ++c) {
      const Eigen::Vector3d corner =
          0.5 * brickSize(brick.kind)
                    .cwiseProduct(Eigen::Vector3d((c & 1) != 0 ? 1 : -1, (c & 2) != 0 ? 1 : -1,
                                                  (c & 4) != 0 ? 1 : -1));
      const Eigen::Vector3d d = R.transpose() * (brick.X_world_brick * corner - eye);
      reach = std::max({reach, std::abs(d.x() / d.z()), std::abs(d.y() / d.z())});
    }
  std::vector<ModelPoint> out;
  std::vector<Raycaster::Ray> packet(kTile * kTile);
  std::vector<Raycaster::Hit> hits(packet.size());
  for (int row = 0; row < pixels; row += kTile)
    for (int column = 0; column < pixels; column += kTile) {
      for (int k = 0; k < kTile * kTile; ++k) {
        const double x = 2.0 * (column + k % kTile + 0.5) / pixels - 1.0,
                     y = 2.0 * (row + k / kTile + 0.5) / pixels - 1.0;
        const Eigen::Vector3d d = R * Eigen::Vector3d(reach * x, reach * y, 1.0).normalized();
        packet[static_cast<std::size_t>(k)] = {eye.cast<float>(), d.cast<float>(), 1e3F, 1};
      }
      rays.cast(packet, hits, true);
      for (std::size_t k = 0; k < hits.size(); ++k) {
        if (!hits[k].valid()) continue;
        const int brick = static_cast<int>(hits[k].instance);
        out.push_back({packet[k].origin + hits[k].range * packet[k].direction, hits[k].normal,
                       brick,
                       faceOf(world.bricks[static_cast<std::size_t>(brick)], hits[k].normal)});
      }
    }
  return out;
}

ModelWorld pileSeenFromAhead() {
  ModelWorld world;
  int id = 0;
  for (const PileSlot& slot : arenaPile().slots())
    world.bricks.push_back({id++, slot.kind, slot.X_pile_brick});
  world.sensors = {{1.9, -2.8, 1.55}};
  return world;
}

}  // namespace kiln
