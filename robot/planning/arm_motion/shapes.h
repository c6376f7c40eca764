#pragma once

#include <string>

#include "common/geom/capsule.h"

namespace kiln {

/// A box with its own axes. Metres.
struct OrientedBox {
  Eigen::Isometry3d X_frame_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds;  ///< in the frame; for quick rejection
  std::string name;
};
[[nodiscard]] OrientedBox makeBox(const Eigen::Isometry3d& X_frame_box, const Eigen::Vector3d& size,
                                  std::string name);

[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Capsule& capsule);

/// Signed distance of a point to a box given in the box's axes; negative inside.
[[nodiscard]] double signedDistance(const Eigen::Vector3d& p_box, const Eigen::Vector3d& half);
/// Distances of two solids, m, by FCL; negative: how deep they are in one another.
[[nodiscard]] double distance(const Capsule& capsule, const OrientedBox& box);
[[nodiscard]] double distance(const Capsule& first, const Capsule& second);
[[nodiscard]] double distance(const OrientedBox& first, const OrientedBox& second);

}  // namespace kiln
