#include "robot/sim/true_ground.h"

#include <cmath>

#include "robot/sim/random.h"

namespace kiln::sim {
namespace {

constexpr double kWide_m = 200.0;  // as far as any ray goes
constexpr double kThick_m = 1.0;

/// A box whose top face passes through (x0, z0) and (x1, z1).
SolidBox slab(const char* name, double x0, double z0, double x1, double z1, double temperature_c) {
  SolidBox b;
  b.name = name;
  b.material = Material::Floor;
  b.temperature_c = temperature_c;
  const double slope = std::atan2(z1 - z0, x1 - x0);
  b.X_map_box = makePose({0.5 * (x0 + x1), 0, 0.5 * (z0 + z1)}, {0, -slope, 0}) *
                Eigen::Translation3d(0, 0, -0.5 * kThick_m);
  b.size_m = {std::hypot(x1 - x0, z1 - z0), kWide_m, kThick_m};
  return b;
}

}  // namespace

GroundProfile drawGround(const WorldConfig& config, const ArenaMap& nominal, std::uint64_t seed) {
  if (!config.approach) return GroundProfile();
  Random random(seed, "ground");
  ApproachConfig a = nominal.approach;
  const PerturbationConfig& c = config.perturbation;
  a.slope_deg = std::max(0.0, a.slope_deg + random.uniform(-c.slope_deg, c.slope_deg));
  a.edge_m = std::max(0.0, a.edge_m + random.uniform(-c.edge_m, c.edge_m));
  return GroundProfile(a);
}

std::vector<SolidBox> groundBoxes(const GroundProfile& ground, double temperature_c) {
  const double low = ground.lowest(), far = 0.5 * kWide_m;
  if (ground.flat()) return {slab("floor", -far, 0, far, 0, temperature_c)};
  const ApproachConfig& a = ground.approach();
  std::vector<SolidBox> out{slab("floor start", -far, low, far, low, temperature_c)};
  if (a.top_x_m > a.foot_x_m && a.slope_deg > 0) {
    out.push_back(slab("floor ramp", a.foot_x_m, low, a.top_x_m, ground.landing(), temperature_c));
  }
  out.push_back(
      slab("floor landing", a.top_x_m, ground.landing(), far, ground.landing(), temperature_c));
  out.push_back(slab("floor kitchen", a.edge_x_m, 0, far, 0, temperature_c));
  return out;
}

}  // namespace kiln::sim
