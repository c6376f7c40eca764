#include "robot/evaluation/marker/marker_yard.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "common/core/units.h"
#include "robot/scene/wall_layout.h"

namespace kiln {
namespace {

const Albedo kRed = albedo(190, 32, 36), kGreen = albedo(40, 130, 62), kBlue = albedo(30, 70, 170),
             kOrange = albedo(226, 110, 24), kPink = albedo(214, 58, 130),
             kVest = albedo(226, 220, 40), kSkin = albedo(190, 140, 110),
             kDark = albedo(44, 48, 60), kWood = albedo(170, 136, 96),
             kPale = albedo(206, 204, 196);

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double normal(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }
  bool chance(double p) { return between(0.0, 1.0) < p; }
  template <class T>
  const T& oneOf(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(between(0.0, 0.9999) * static_cast<double>(all.size()))];
  }

 private:
  std::mt19937_64 random_;
};

Eigen::Vector2d middleOfMarker(const Pose2& X_map_wall) {
  const Pose2 p = X_map_wall * Pose2{kMarkerLength_m / 2.0, kMarkerLength_m / 2.0, 0.0};
  return {p.x_m, p.y_m};
}

void addBox(MarkerScene& scene, const Pose2& X_map_foot, const Eigen::Vector3d& size,
            const Albedo& colour, double bottom_m = 0.0) {
  ColouredBox box;
  box.X_map_box = toIsometry(X_map_foot);
  box.X_map_box.translation().z() = scene.ground.height(X_map_foot.x_m) + bottom_m + 0.5 * size.z();
  box.size_m = size;
  box.colour = colour;
  scene.boxes.push_back(box);
}

/// Stacks of bricks beside each other, five high.
void addPile(MarkerScene& scene, const Pose2& X_map_pile, Draw& draw) {
  struct Kind {
    double length_m;
    Albedo colour;
  };
  const std::vector<Kind> kinds{{0.3, kRed}, {0.6, kGreen}, {1.2, kBlue}, {1.8, kOrange}};
  double along = 0.0;
  for (int stack = 0; stack < 5; ++stack) {
    const Kind& kind = stack == 0 ? kinds[3] : draw.oneOf(kinds);
    for (int layer = 0; layer < 5; ++layer)
      addBox(scene,
             X_map_pile * Pose2{along + 0.5 * kind.length_m + draw.normal(0.005),
                                draw.normal(0.005), draw.normal(1.0 * kDeg)},
             {kind.length_m, 0.2, 0.2}, kind.colour, 0.2 * layer);
    along += kind.length_m + 0.1;
  }
}

void addPerson(MarkerScene& scene, const Pose2& X, Draw& draw) {
  addBox(scene, X, {0.22, 0.30, 0.85}, kDark);
  addBox(scene, X, {0.26, 0.46, 0.65}, kPink, 0.85);
  if (draw.chance(0.7)) addBox(scene, X, {0.28, 0.34, 0.45}, kVest, 0.92);  // an open vest
  addBox(scene, X, {0.20, 0.18, 0.26}, kSkin, 1.52);
}

/// Somewhere in view but not between robot and marker, nor on it.
Pose2 beside(const MarkerYard& yard, Draw& draw, double clear_m) {
  const Eigen::Vector2d middle = middleOfMarker(yard.scene.X_map_wall);
  for (;;) {
    const double bearing = draw.between(-40.0, 40.0) * kDeg + yard.X_map_end.yaw_rad;
    const double range = draw.between(3.0, 22.0);
    const Eigen::Vector2d p(yard.X_map_end.x_m + range * std::cos(bearing),
                            yard.X_map_end.y_m + range * std::sin(bearing));
    if (p.x() < -2.0 && p.x() < middle.x() - 4.0) continue;  // not on the slope
    // Clear of the corridor from both ends of the drive to the marker's square.
    bool hides = false;
    for (const Pose2& from : {yard.X_map_start, yard.X_map_end}) {
      const Eigen::Vector2d eye(from.x_m, from.y_m), to = middle - eye;
      const double t = std::clamp((p - eye).dot(to) / to.squaredNorm(), 0.0, 1.0);
      const double width = clear_m + t * 3.0;
      hides |= (p - eye - t * to).norm() < width;
    }
    if (!hides) return {p.x(), p.y(), draw.between(-M_PI, M_PI)};
  }
}

void hide(MarkerScene& scene, MarkerCase what, Draw& draw) {
  FlatPatch sheet;
  sheet.colour = draw.chance(0.5) ? scene.ground_colour : kPale;
  const double half = 0.5 * kMarkerLength_m;
  if (what == MarkerCase::LegHidden) {
    // From 0.45 to 0.85 of one leg, measured from its end or from the corner.
    const double hidden = draw.between(0.45, 0.85) * (kMarkerLength_m - kMarkerWidth_m);
    const double from = draw.chance(0.6) ? kMarkerLength_m + 0.05 - hidden : kMarkerWidth_m;
    const bool along_x = draw.chance(0.5);
    const double mid = from + 0.5 * hidden, across = 0.5 * kMarkerWidth_m;
    sheet.X_map_patch =
        scene.X_map_wall * (along_x ? Pose2{mid, across, 0.0} : Pose2{across, mid, 0.0});
    sheet.size_m = along_x ? Eigen::Vector2d(hidden, 0.8) : Eigen::Vector2d(0.8, hidden);
  } else {
    const double side = draw.between(0.9, 1.6) * half;
    sheet.X_map_patch = scene.X_map_wall * Pose2{0.5 * side - 0.1, 0.5 * side - 0.1, 0.0};
    sheet.size_m = {side, side};
  }
  scene.patches.push_back(sheet);
}

void addThings(MarkerYard& yard, Draw& draw) {
  MarkerScene& scene = yard.scene;
  addPile(scene, beside(yard, draw, 1.5), draw);
  if (draw.chance(0.7)) addPile(scene, beside(yard, draw, 1.5), draw);
  if (draw.chance(0.6))
    addBox(scene, beside(yard, draw, 1.5), {2.4, 0.2, 1.0}, kOrange);  // a wall of orange bricks
  if (draw.chance(0.7)) addPerson(scene, beside(yard, draw, 0.6), draw);
  for (int i = 0; i < 2; ++i) addBox(scene, beside(yard, draw, 0.8), {0.8, 0.6, 0.6}, kWood);
  for (const Albedo& colour : {scene.yellow, scene.magenta})
    if (draw.chance(0.7))
      scene.patches.push_back(
          {beside(yard, draw, 1.2), {draw.between(0.4, 1.5), draw.between(0.4, 1.5)}, colour});
  // The fence: posts and a rail, yellow and black by turns.
  for (int i = -8; i <= 8; ++i)
    addBox(scene, Pose2{14.0, 2.0 * i, 0.0}, {0.08, 1.2, 0.12}, i % 2 == 0 ? kVest : kDark, 0.9);
}

}  // namespace

MarkerYard drawYard(MarkerCase what, double distance_m, std::uint64_t seed) {
  Draw draw(seed);
  MarkerYard yard;
  MarkerScene& scene = yard.scene;
  scene.what = what;
  ApproachConfig slope;
  slope.top_x_m = -draw.between(3.2, 4.5);  // the marker's square is 2.9 m to its corners
  slope.foot_x_m = slope.top_x_m - 4.0;
  slope.edge_x_m = slope.top_x_m;
  slope.slope_deg = 3.0;
  scene.ground = GroundProfile(slope);
  const double yaw = draw.between(-M_PI, M_PI);
  const Eigen::Vector2d middle =
      Eigen::Rotation2Dd(yaw) * Eigen::Vector2d::Constant(kMarkerLength_m / 2.0);
  scene.X_map_wall = {-middle.x(), -middle.y(), yaw};  // its middle is the origin
  scene.sun_elevation_rad = draw.between(15.0, 70.0) * kDeg;
  scene.sun_azimuth_rad = draw.between(-M_PI, M_PI);
  scene.dust = static_cast<float>(draw.between(0.0, 0.25));
  scene.gloss = static_cast<float>(draw.between(0.0, 0.25));
  scene.ground_colour = draw.chance(0.6)   ? albedo(128, 126, 122)   // slabs
                        : draw.chance(0.6) ? albedo(96, 94, 92)      // asphalt
                                           : albedo(176, 158, 132);  // sand
  if (what == MarkerCase::OtherColour) {
    scene.magenta = kGreen;
    scene.yellow = kBlue;
  }

  yard.camera.exposure_stops = draw.normal(0.35);
  yard.camera.balance = {static_cast<float>(std::exp(draw.normal(0.05))), 1.0F,
                         static_cast<float>(std::exp(draw.normal(0.06)))};
  yard.camera.noise = draw.between(0.004, 0.010);

  // It comes up the slope, up to 20 degrees off, and looks at the marker but for 10 degrees.
  const double bearing = draw.between(-20.0, 20.0) * kDeg;
  const double way = draw.between(0.6, 1.6);
  const auto standing = [&](double distance) {
    const double heading = bearing + draw.between(-10.0, 10.0) * kDeg;
    return Pose2{-distance * std::cos(bearing), -distance * std::sin(bearing), heading};
  };
  yard.X_map_start = standing(distance_m + way);
  yard.X_map_end = standing(distance_m);

  addThings(yard, draw);
  if (what == MarkerCase::LegHidden || what == MarkerCase::CornerHidden) hide(scene, what, draw);
  return yard;
}

}  // namespace kiln
