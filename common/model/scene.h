#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/core/stamp.h"
#include "common/geom/pose.h"
#include "common/model/mission.h"

namespace kiln {

/// A box of the nominal arena, for drawing. Frame: map, metres.
struct SceneBox {
  std::string name;
  Eigen::Isometry3d X_map_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_extent = Eigen::Vector3d::Zero();
  std::uint32_t rgb = 0x808080;  ///< 0xRRGGBB
};

/// Planned path, for the scene.
struct PathInfo {
  Stamp stamp;
  std::vector<Pose2> waypoints_map;
  int next = 0;
};

/// What something in the scene means; the station chooses colour and line.
enum class ItemStyle : std::uint8_t {
  Normal,
  Configured,  ///< as the operator's files say: dashed
  Sensed,      ///< as the sensors say
  Planned,     ///< will be, or would be
  Suspected,   ///< to be looked at
  Done,
  Target,
  Active,  ///< happens now
  Caution,
  Intent  ///< what an operator is about to do; drawn by stations alone
};

/// Something that a mission draws. Frame: map, metres.
struct SceneItem {
  enum class Shape : std::uint8_t {
    Polyline,  ///< `points`
    Box,  ///< its twelve edges, seen through everything: X_map_item is its centre, `size` whole
    Estimate,  ///< a point that was estimated: X_map_item's origin, `covariance` as an ellipsoid
    Text,      ///< label alone, at X_map_item's origin
    Arrow,     ///< along `points`, its head at the last one
    Cylinder   ///< upright in X_map_item, its centre; `size` x and y: diameters, z: height
  };
  std::string id;     ///< of its kind in the layer; what a click on it names
  std::string layer;  ///< LayerSpec::id
  Shape shape = Shape::Polyline;
  ItemStyle style = ItemStyle::Normal;
  Eigen::Isometry3d X_map_item = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> points{};
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< m^2; of an Estimate
  double width_px = 1.0;                                 ///< of lines
  std::string label{};   ///< "place 1 · 0.86 m"; drawn at X_map_item's origin
  std::string detail{};  ///< a second line
};

/// Everything the scene overlays on the live robot; mirrors kiln.v1.Scene. Sent when it changes and
/// every 2 s.
struct Scene {
  Stamp stamp;
  PathInfo planned;
  std::vector<SceneBox> arena;
  std::vector<SceneItem> items;
  MissionDetail detail;  ///< what the items were made of, for the mission's panels
};

}  // namespace kiln
