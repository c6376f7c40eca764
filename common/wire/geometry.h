#pragma once

#include <array>

#include "common/core/error.h"
#include "common/geom/pose.h"
#include "kiln/v1/geometry.pb.h"

/// model <-> geometry.proto. For the .cpp files of this folder alone.
namespace kiln::wire {

void toProto(const Eigen::Vector3d& p, v1::Vec3& out);
void toProto(const Pose2& pose, v1::Pose2& out);
void toProto(const Twist2& twist, v1::Twist2& out);
void toProto(const Eigen::Isometry3d& X, v1::Pose3& out);

[[nodiscard]] Eigen::Vector3d fromProto(const v1::Vec3& p);
[[nodiscard]] Pose2 fromProto(const v1::Pose2& pose);
[[nodiscard]] Twist2 fromProto(const v1::Twist2& twist);
/// Error when the quaternion is not of unit length within 1e-3 or anything is not finite.
[[nodiscard]] Result<Eigen::Isometry3d> fromProto(const v1::Pose3& X, const char* what);

/// Repeated doubles into a fixed array; Error when the count differs.
template <class Repeated, class Fixed>
[[nodiscard]] Result<void> copyFixed(const Repeated& in, Fixed& out, const char* what) {
  if (static_cast<std::size_t>(in.size()) != static_cast<std::size_t>(out.size())) {
    return makeError(ErrorCode::InvalidInput, "{}: {} values, {} are due; dropped", what, in.size(),
                     out.size());
  }
  for (int i = 0; i < in.size(); ++i) out[static_cast<std::size_t>(i)] = in.Get(i);
  return {};
}

}  // namespace kiln::wire
