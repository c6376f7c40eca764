#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "robot/perception/bricks/brick_blocks.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/perception/bricks/model_cloud.h"

namespace kiln {

/// The beams of a sweep by direction, so that those near one brick are found without asking all.
/// Keeps a view of the beams.
class BeamIndex {
 public:
  /// @param ahead  somewhere in the middle of the bricks; what lies more than about 75 deg beside it
  ///               as seen from the sensor is not indexed.
  BeamIndex(std::span<const Beam> beams, const Eigen::Vector3d& p_sensor,
            const Eigen::Vector3d& ahead);
  /// Beams that may pass within `margin_m` of the brick (and others).
  [[nodiscard]] std::vector<std::uint32_t> near(const ModelBrick& brick, double margin_m) const;
  [[nodiscard]] const Beam& beam(std::uint32_t i) const { return beams_[i]; }

 private:
  /// In the tangent plane ahead, in cells; false: too far aside to be of interest.
  [[nodiscard]] bool project(const Eigen::Vector3f& p, Eigen::Vector2f& cell) const;
  std::span<const Beam> beams_;
  Eigen::Vector3f p_sensor_;
  Eigen::Matrix3f axes_;              ///< rows: right, up, ahead
  float parallax_m_ = 0.0F;           ///< farthest that an origin lies from p_sensor_
  std::vector<std::uint32_t> first_;  ///< by cell, into sorted_; one more at the end
  std::vector<std::uint32_t> sorted_;
};

/// How beams are told apart at a surface, along its normal.
struct BeamGates {
  double on_m = 0.04;       ///< ends within it: met the surface
  double through_m = 0.06;  ///< ends farther behind it: nothing stands there
  double window_m = 0.12;   ///< each side of where an edge is expected: looked for within it
  double beside_m = 0.025;  ///< each side of an edge: beams that judge it
  int min_beams = 8;        ///< on either side of an edge
  double max_wrong = 0.2;   ///< share of the smaller side that may contradict an edge
  void visit(ConfigArchive& a);
};

/// Where a brick's outline is, as seen: of each edge behind which the LiDAR sees past the brick, the
/// place between the beams that end on the face and those that go on. A beam's direction has no
/// range noise, so an edge is found to a few millimetres where the faces alone tell nothing along
/// themselves. Each is a correspondence: p on the brick at `brick`'s pose, n in the face across the
/// edge, weight 1. Long edges yield one for each 0.3 m.
[[nodiscard]] std::vector<Correspondence> outline(const BeamIndex& index, const ModelBrick& brick,
                                                  std::span<const std::uint32_t> beams,
                                                  const Eigen::Vector3d& p_sensor,
                                                  const BeamGates& gates);

/// What the beams say of the surface of a brick that should be in sight, in cells of its lattice.
struct SurfaceEvidence {
  int expected = 0;     ///< in sight by the model
  int found = 0;        ///< met by beams
  int empty = 0;        ///< beams go on through it
  int hidden = 0;       ///< something else, not in the model, stands before it
  int sides_found = 0;  ///< faces with at least a third of their expected cells found
};
[[nodiscard]] SurfaceEvidence weigh(const BeamIndex& index, const ModelBrick& brick,
                                    const std::array<FaceGrid, 6>& lattice,
                                    std::span<const std::uint32_t> beams, const BeamGates& gates);

}  // namespace kiln
