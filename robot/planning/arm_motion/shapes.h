#pragma once

#include <array>
#include <string>

#include <Eigen/Geometry>

namespace kiln {

/// A box with its own axes. Metres.
struct OrientedBox {
  Eigen::Isometry3d X_frame_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  double sphere_radius = 0.0;  ///< about the centre; for quick rejection
  std::string name;
};
[[nodiscard]] OrientedBox makeBox(const Eigen::Isometry3d& X_frame_box, const Eigen::Vector3d& size,
                                  std::string name);

struct Capsule {
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// Signed distance of a point to a box given in the box's axes; negative inside.
[[nodiscard]] double signedDistance(const Eigen::Vector3d& p_box, const Eigen::Vector3d& half);
/// Signed distance of a capsule to a box, within 1e-4 m; negative: depth of the deepest axis point
/// plus the radius.
[[nodiscard]] double distance(const Capsule& capsule, const OrientedBox& box);
/// Distance of two capsules; negative when they overlap.
[[nodiscard]] double distance(const Capsule& first, const Capsule& second);
/// Widest gap over the fifteen separating axes: never more than the true distance, equal to it face
/// to face, and the negative penetration depth when the boxes overlap.
[[nodiscard]] double separation(const OrientedBox& first, const OrientedBox& second);

}  // namespace kiln
