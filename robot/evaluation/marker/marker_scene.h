#pragma once

#include <string_view>
#include <vector>

#include "robot/scene/ground_profile.h"

namespace kiln {

/// What lies or stands where the marker should be.
enum class MarkerCase : std::uint8_t {
  Whole,
  Absent,        ///< only the things that look a little like it
  OneLeg,        ///< the leg along X alone
  LegHidden,     ///< most of one leg under a sheet
  CornerHidden,  ///< the corner and some of both legs under a sheet
  OtherColour,   ///< the same pattern in green and blue
  OneColour,     ///< an L of magenta alone
  Small,         ///< the same pattern at 0.6 of its size
};
[[nodiscard]] std::string_view toString(MarkerCase what);

/// Reflectance by channel, linear, 0 to 1.
using Albedo = Eigen::Vector3f;
/// From display values 0 to 255 (sRGB).
[[nodiscard]] Albedo albedo(int red, int green, int blue);

/// Something flat on the ground.
struct FlatPatch {
  Pose2 X_map_patch;
  Eigen::Vector2d size_m = Eigen::Vector2d::Ones();  ///< about its origin
  Albedo colour = Albedo::Constant(0.5F);
};
/// A box on the ground.
struct ColouredBox {
  Eigen::Isometry3d X_map_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  Albedo colour = Albedo::Constant(0.5F);
};

/// Everything that a picture of the marker depends on beside the camera: what scenario.md section 4
/// says of arena, marker, sun and distractors, drawn by seed. Map frame: Z up, z = 0 on the level
/// ground on which the marker lies; the slope rises along +X before it.
struct MarkerScene {
  MarkerCase what = MarkerCase::Whole;
  GroundProfile ground;
  Pose2 X_map_wall;  ///< wall_layout.h
  Albedo magenta = albedo(206, 36, 126), yellow = albedo(244, 206, 36);
  float dust = 0.1F;   ///< share of the ground's colour on the marker
  float gloss = 0.1F;  ///< of the marker's foil, at grazing reflection
  Albedo ground_colour = albedo(128, 126, 122);
  double texture = 0.12;           ///< relative, of the ground
  std::vector<FlatPatch> patches;  ///< later ones lie on top
  std::vector<ColouredBox> boxes;
  double sun_elevation_rad = 0.8, sun_azimuth_rad = 0.0;  ///< azimuth from +X of map, towards it
  /// Colour of the ground at p (map), marker and patches included. @param foil  set if it is the
  /// marker itself.
  [[nodiscard]] Albedo groundColour(const Eigen::Vector2d& p_map, bool& foil) const;
  /// Names the evenly coloured piece of ground at p: neighbours in one piece need no finer rays.
  [[nodiscard]] int groundPiece(const Eigen::Vector2d& p_map) const;
  [[nodiscard]] Eigen::Vector3f toSun() const;
};

}  // namespace kiln
