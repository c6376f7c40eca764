#include "robot/evaluation/marker/marker_scene.h"

#include <cmath>

#include "robot/scene/wall_layout.h"

namespace kiln {
namespace {

// A chequered foil: four squares across a leg, with a rim of 1 cm: 4 x 0.1 + 0.02 = 0.42 m and
// 40 x 0.1 + 0.02 = 4.02 m.
constexpr double kSquare_m = 0.1, kRim_m = 0.01;
constexpr double kSmall = 0.6;

enum Piece : int { kNothing = 0, kMagenta = 1, kYellow = 2 };

bool onLeg(double along, double across) {
  return along >= 0.0 && along <= kMarkerLength_m && across >= 0.0 && across <= kMarkerWidth_m;
}

/// What of the marker lies at p (wall frame).
Piece pieceAt(MarkerCase what, Eigen::Vector2d p) {
  if (what == MarkerCase::Absent) return kNothing;
  if (what == MarkerCase::Small) p /= kSmall;
  const bool on_x = onLeg(p.x(), p.y());
  const bool on_y = what != MarkerCase::OneLeg && onLeg(p.y(), p.x());
  if (!on_x && !on_y) return kNothing;
  if (what == MarkerCase::OneColour) return kMagenta;
  const Eigen::Vector2d grid = (p.array() - kRim_m) / kSquare_m;
  const double last = std::round((kMarkerLength_m - 2.0 * kRim_m) / kSquare_m);
  const double row = std::round((kMarkerWidth_m - 2.0 * kRim_m) / kSquare_m);
  const bool rim = grid.minCoeff() < 0.0 || grid.maxCoeff() > last || (!on_y && grid.y() > row) ||
                   (!on_x && grid.x() > row);
  if (rim) return kMagenta;
  const int parity =
      static_cast<int>(std::floor(grid.x())) + static_cast<int>(std::floor(grid.y()));
  return parity % 2 == 0 ? kMagenta : kYellow;
}

float hash(int x, int y) {
  std::uint32_t h =
      static_cast<std::uint32_t>(x) * 374761393U + static_cast<std::uint32_t>(y) * 668265263U;
  h = (h ^ (h >> 13U)) * 1274126177U;
  return static_cast<float>((h ^ (h >> 16U)) & 0xffffU) / 32768.0F - 1.0F;
}

/// Value noise, -1 to 1.
float noise(const Eigen::Vector2d& p) {
  const double fx = std::floor(p.x()), fy = std::floor(p.y());
  const int x = static_cast<int>(fx), y = static_cast<int>(fy);
  const auto a = static_cast<float>(p.x() - fx), b = static_cast<float>(p.y() - fy);
  const float low = hash(x, y) + a * (hash(x + 1, y) - hash(x, y));
  const float high = hash(x, y + 1) + a * (hash(x + 1, y + 1) - hash(x, y + 1));
  return low + b * (high - low);
}

}  // namespace

std::string_view toString(MarkerCase what) {
  switch (what) {
    case MarkerCase::Whole:
      return "whole";
    case MarkerCase::Absent:
      return "absent";
    case MarkerCase::OneLeg:
      return "one leg";
    case MarkerCase::LegHidden:
      return "leg hidden";
    case MarkerCase::CornerHidden:
      return "corner hidden";
    case MarkerCase::OtherColour:
      return "other colour";
    case MarkerCase::OneColour:
      return "one colour";
    case MarkerCase::Small:
      return "small";
  }
  return "unknown";
}

Albedo albedo(int red, int green, int blue) {
  const auto linear = [](int v) {
    const float s = static_cast<float>(v) / 255.0F;
    return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
  };
  return {linear(red), linear(green), linear(blue)};
}

Albedo MarkerScene::groundColour(const Eigen::Vector2d& p_map, bool& foil) const {
  foil = false;
  const auto grain = static_cast<float>(texture);
  const float grey = 1.0F + grain * (0.5F * noise(p_map / 0.02) + 0.35F * noise(p_map / 0.25) +
                                     0.35F * noise(p_map / 2.0));
  const Albedo bare = grey * ground_colour;
  for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch) {
    const Pose2 in = inverse(patch->X_map_patch) * Pose2{p_map.x(), p_map.y(), 0.0};
    if (std::abs(in.x_m) <= 0.5 * patch->size_m.x() && std::abs(in.y_m) <= 0.5 * patch->size_m.y())
      return grey * patch->colour;
  }
  const Pose2 in = inverse(X_map_wall) * Pose2{p_map.x(), p_map.y(), 0.0};
  const Piece piece = pieceAt(what, {in.x_m, in.y_m});
  if (piece == kNothing) return bare;
  foil = true;
  return (1.0F - dust) * (piece == kYellow ? yellow : magenta) + dust * bare;
}

int MarkerScene::groundPiece(const Eigen::Vector2d& p_map) const {
  for (std::size_t i = patches.size(); i-- > 0;) {
    const Pose2 in = inverse(patches[i].X_map_patch) * Pose2{p_map.x(), p_map.y(), 0.0};
    if (std::abs(in.x_m) <= 0.5 * patches[i].size_m.x() &&
        std::abs(in.y_m) <= 0.5 * patches[i].size_m.y())
      return static_cast<int>(i) + 3;
  }
  const Pose2 in = inverse(X_map_wall) * Pose2{p_map.x(), p_map.y(), 0.0};
  return pieceAt(what, {in.x_m, in.y_m});
}

Eigen::Vector3f MarkerScene::toSun() const {
  return Eigen::Vector3d(std::cos(sun_elevation_rad) * std::cos(sun_azimuth_rad),
                         std::cos(sun_elevation_rad) * std::sin(sun_azimuth_rad),
                         std::sin(sun_elevation_rad))
      .cast<float>();
}

}  // namespace kiln
