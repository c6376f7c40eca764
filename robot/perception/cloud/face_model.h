#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace kiln {

/// A flat rectangle of an object's surface. Axes u, v span it, n = u x v points outward.
struct Face {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d u, v, n;
  double half_u = 0.0, half_v = 0.0;
};

/// Nearest point of a face.
struct FacePoint {
  const Face* face = nullptr;
  Eigen::Vector3d p;
  double distance_m = 0.0;
};

/// The six faces of an upright box in the object's frame.
void appendBoxFaces(std::vector<Face>& faces, const Eigen::Vector3d& low,
                    const Eigen::Vector3d& high);

/// Sizes of a fire place; metres.
struct FireBoxSizes {
  double box = 0.4, opening = 0.15;                            ///< edge; diameter
  double bar = 0.025;                                          ///< opaque frame along the edges
  double rim = 0.015;                                          ///< opaque rim around the opening
  double recess = 0.10;                                        ///< plate behind the opening
  double table = 0.7, table_height = 0.8, table_ahead = 0.05;  ///< its edge before the box's front
};

/// The opaque surfaces of a fire place in its front frame (origin in the middle of the opening, in
/// the outer face; X outward, Z up): frame bars, rim of the opening, table. Acrylic lets 97 % of
/// the rays pass and is left out.
[[nodiscard]] std::vector<Face> fireBoxFaces(const FireBoxSizes& sizes);

/// Nearest face that a sensor at `p_sensor` sees from outside, within `gate_m`. All in the object's
/// frame.
[[nodiscard]] std::optional<FacePoint> nearestFace(std::span<const Face> faces,
                                                   const Eigen::Vector3d& p,
                                                   const Eigen::Vector3d& p_sensor, double gate_m);

}  // namespace kiln
