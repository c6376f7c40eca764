#include "robot/planning/arm_motion/shapes.h"

#include <algorithm>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace kiln {
namespace {

constexpr std::size_t kContacts = 4;

template <class Shape>
struct Placed {
  Shape shape;
  Eigen::Isometry3d X;
};

Placed<fcl::Boxd> placed(const OrientedBox& box) {
  return {fcl::Boxd(2.0 * box.half), box.X_frame_box};
}

/// FCL's lies along its own Z, with the middle at the origin.
Placed<fcl::Capsuled> placed(const Capsule& capsule) {
  const Eigen::Vector3d along = capsule.b - capsule.a;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along).toRotationMatrix();
  X.translation() = 0.5 * (capsule.a + capsule.b);
  return {fcl::Capsuled(capsule.radius, along.norm()), X};
}

template <class First, class Second>
double distanceOf(const Placed<First>& first, const Placed<Second>& second) {
  fcl::DistanceResultd apart;
  fcl::distance(&first.shape, first.X, &second.shape, second.X, fcl::DistanceRequestd(), apart);
  if (apart.min_distance > 0.0) return apart.min_distance;
  const fcl::CollisionRequestd request(kContacts, true);
  fcl::CollisionResultd inside;
  fcl::collide(&first.shape, first.X, &second.shape, second.X, request, inside);
  double depth = 0.0;
  for (std::size_t i = 0; i < inside.numContacts(); ++i)
    depth = std::max(depth, inside.getContact(i).penetration_depth);
  return -depth;
}

}  // namespace

OrientedBox makeBox(const Eigen::Isometry3d& X_frame_box, const Eigen::Vector3d& size,
                    std::string name) {
  const Eigen::Vector3d half = 0.5 * size, reach = X_frame_box.linear().cwiseAbs() * half;
  return {X_frame_box,
          half,
          {X_frame_box.translation() - reach, X_frame_box.translation() + reach},
          std::move(name)};
}

Eigen::AlignedBox3d boundsOf(const Capsule& capsule) {
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(capsule.radius);
  return {capsule.a.cwiseMin(capsule.b) - around, capsule.a.cwiseMax(capsule.b) + around};
}

double signedDistance(const Eigen::Vector3d& p_box, const Eigen::Vector3d& half) {
  const Eigen::Vector3d excess = p_box.cwiseAbs() - half;
  return excess.cwiseMax(0.0).norm() + std::min(0.0, excess.maxCoeff());
}

double distance(const Capsule& capsule, const OrientedBox& box) {
  return distanceOf(placed(capsule), placed(box));
}

double distance(const Capsule& first, const Capsule& second) {
  return distanceOf(placed(first), placed(second));
}

double distance(const OrientedBox& first, const OrientedBox& second) {
  return distanceOf(placed(first), placed(second));
}

}  // namespace kiln
