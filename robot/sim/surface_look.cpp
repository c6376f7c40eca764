#include "robot/sim/surface_look.h"

#include <algorithm>
#include <cmath>

namespace kiln::sim {
namespace {

using Colour = Eigen::Vector3f;

// Metres: floor tiles inside, slabs outside, half-widths of the lines between them.
constexpr float kTile = 0.5F, kJoint = 0.008F, kSlab = 2.0F, kLine = 0.02F;

Colour mix(const Colour& a, const Colour& b, float share) {
  return a + std::clamp(share, 0.0F, 1.0F) * (b - a);
}

/// std::floor is a library call on the baseline x86-64, and this runs for every pixel.
int wholePart(float x) {
  const int i = static_cast<int>(x);
  return x < static_cast<float>(i) ? i - 1 : i;
}

/// Whether x is nearer than `half` to a line of a grid.
bool onLine(float x, float pitch, float half) {
  const float cell = x / pitch + 0.5F;
  return std::fabs(cell - static_cast<float>(wholePart(cell)) - 0.5F) * pitch < half;
}

bool inBuilding(const Eigen::Vector3f& p) {
  return p.x() > 5.0F && p.x() < 14.0F && std::fabs(p.y()) < 6.0F;
}

Colour groundColour(const Eigen::Vector3f& p) {
  const bool line = onLine(p.x(), kSlab, kLine) || onLine(p.y(), kSlab, kLine);
  return line ? Colour(150, 148, 142) : Colour(128, 126, 122);
}

Colour floorColour(const Eigen::Vector3f& p) {
  if (!inBuilding(p)) return groundColour(p);
  const bool joint = onLine(p.x(), kTile, kJoint) || onLine(p.y(), kTile, kJoint);
  if (joint) return {120, 112, 104};
  const int tile = wholePart(p.x() / kTile) + wholePart(p.y() / kTile);
  return tile % 2 == 0 ? Colour(196, 184, 168) : Colour(184, 172, 156);
}

Colour wallColour(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) {
  if (p.z() < 0.10F) return {96, 88, 82};  // skirting
  if (std::fabs(normal.z()) < 0.5F && p.z() > 1.10F && p.z() < 1.14F) return {150, 158, 160};
  return p.z() < 1.10F ? Colour(186, 196, 196) : Colour(222, 220, 212);
}

Colour plateColour(double temperature_c) {
  // Red heat needs 500 degC; the show glows, so that an operator sees which place burns.
  return mix({92, 92, 98}, {255, 126, 24}, static_cast<float>((temperature_c - 30.0) / 90.0));
}

}  // namespace

SurfaceLook surfaceLook(Material material, const Eigen::Vector3f& p, const Eigen::Vector3f& normal,
                        double temperature_c) {
  switch (material) {
    case Material::Floor:
      return {floorColour(p), false};
    case Material::Ground:
      return {groundColour(p), false};
    case Material::Wall:
      return {wallColour(p, normal), false};
    case Material::Furniture:
      return {normal.z() > 0.5F ? Colour(176, 142, 104) : Colour(150, 112, 76), false};
    case Material::Table:
      return {normal.z() > 0.5F ? Colour(150, 154, 160) : Colour(110, 114, 120), false};
    case Material::Frame:
      return {Colour(64, 66, 72), false};
    case Material::Plate:
      return {plateColour(temperature_c), temperature_c > 40.0};
    case Material::Flame:
      return {mix({255, 150, 20}, {255, 232, 120}, 3.0F * std::fabs(std::sin(40.0F * p.z()))),
              true};
    case Material::WarmBody:
      return {Colour(70, 98, 150), false};
    case Material::Person:
      return {p.z() > 0.9F ? Colour(178, 74, 60) : Colour(52, 60, 84), false};
    case Material::Chassis:
      return {normal.z() > 0.5F ? Colour(78, 82, 88) : Colour(58, 62, 68), false};
    case Material::Tank:
      return {Colour(120, 170, 210), false};
    case Material::ArmLink:
      return {Colour(206, 210, 214), false};
    case Material::ArmJoint:
      return {Colour(96, 150, 196), false};
    case Material::Head:
      return {Colour(74, 76, 80), false};
    case Material::Hose:
      return {Colour(40, 92, 168), false};
    case Material::Wheel:
      return {Colour(34, 34, 36), false};
    case Material::Water:
      return {Colour(196, 226, 255), true};
    case Material::Obstacle:
      return {Colour(214, 60, 60), false};
    case Material::BrickRed:
      return {Colour(196, 34, 38), false};
    case Material::BrickGreen:
      return {Colour(44, 160, 84), false};
    case Material::BrickBlue:
      return {Colour(36, 88, 190), false};
    case Material::BrickOrange:
      return {Colour(232, 124, 28), false};
    case Material::MarkerMagenta:
      return {Colour(198, 36, 132), false};
    case Material::MarkerYellow:
      return {Colour(240, 206, 40), false};
    case Material::Storage:
      return {Colour(168, 148, 116), false};
    case Material::Magnets:
      return {Colour(150, 152, 156), false};
    default:
      return {};
  }
}

int surfacePatch(Material material, const Eigen::Vector3f& p) {
  if (material == Material::Flame) return -1;
  if (material == Material::Wall)
    return p.z() < 0.10F ? 1 : p.z() < 1.10F ? 2 : p.z() < 1.14F ? 3 : 4;
  if (material != Material::Floor && material != Material::Ground) return 0;
  const bool inside = material == Material::Floor && inBuilding(p);
  const float pitch = inside ? kTile : kSlab, half = inside ? kJoint : kLine;
  if (onLine(p.x(), pitch, half) || onLine(p.y(), pitch, half)) return -1;
  const int cell = 4096 * (wholePart(p.x() / pitch) + 2048) + wholePart(p.y() / pitch) + 2048;
  return 2 * cell + (inside ? 1 : 0);
}

Eigen::Vector3f Daylight::strength(const Eigen::Vector3f& normal, float sunlit) const {
  const float sky_light = 0.50F + 0.14F * normal.z();
  const float sun_light = 0.62F * sunlit * std::max(0.0F, normal.dot(to_sun));
  const Eigen::Vector3f warm(1.0F, 0.97F, 0.90F), cool(0.94F, 0.97F, 1.0F);
  return sky_light * cool + sun_light * warm;
}

Eigen::Vector3f Daylight::sky(const Eigen::Vector3f& direction) {
  return mix({206, 220, 234}, {104, 156, 218}, 2.2F * direction.z());
}

}  // namespace kiln::sim
