#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/model/fire.h"
#include "common/model/place_check.h"
#include "common/model/status.h"

namespace kiln {

/// A box of the nominal arena, for drawing. Frame: map, metres.
struct SceneBox {
  std::string name;
  Eigen::Isometry3d X_map_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_extent = Eigen::Vector3d::Zero();
  std::uint32_t rgb = 0x808080;  ///< 0xRRGGBB
};

/// Everything the scene overlays on the live robot; mirrors kiln.v1.Scene. Sent when it changes and
/// every 2 s.
struct Scene {
  Stamp stamp;
  std::vector<FireEstimate> fires;
  std::vector<FirePlaceInfo> places;
  PathInfo planned;
  JetPreview jet;
  std::vector<SceneBox> arena;
  std::vector<PlaceCheck> place_checks;  ///< newest of each place that was looked at
};

}  // namespace kiln
