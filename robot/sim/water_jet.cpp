#include "robot/sim/water_jet.h"

#include <cmath>

#include "common/core/units.h"
#include "robot/sim/ray_scene.h"

namespace kiln::sim {
namespace {
constexpr double kGravity = 9.81;
constexpr double kLost_m = -1.0;  // z of a drop that the ground should have stopped
}  // namespace

WaterJet::WaterJet(const WaterConfig& config, const std::vector<TrueFirePlace>& places,
                   std::uint64_t seed)
    : config_(config), places_(places), random_(seed, "water"), delivered_l_(places.size(), 0.0) {}

void WaterJet::emit(double litres, double flow_fraction, const Eigen::Isometry3d& X_map_nozzle,
                    const Eigen::Vector3d& v_nozzle) {
  emitted_l_ += litres;
  waiting_l_ += litres;
  const double drop_l = config_.drop_ml * 1e-3;
  const double sigma = config_.spread_rms_deg * kDeg / M_SQRT2;  // two axes make the whole angle
  while (waiting_l_ >= drop_l) {
    waiting_l_ -= drop_l;
    const Eigen::Vector3d direction =
        Eigen::Vector3d(1.0, random_.normal(sigma), random_.normal(sigma)).normalized();
    Drop drop;
    drop.p = X_map_nozzle.translation();
    drop.X_map_nozzle = X_map_nozzle;
    drop.v =
        v_nozzle + config_.exit_speed_mps * flow_fraction * (X_map_nozzle.linear() * direction);
    drops_.push_back(drop);
  }
}

bool WaterJet::throughOpening(const TrueFirePlace& place, const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b, double& share) {
  const Eigen::Isometry3d X_front_map = place.X_map_front.inverse();
  const Eigen::Vector3d from = X_front_map * a, to = X_front_map * b;
  if (from.x() <= 0.0 || to.x() > 0.0) return false;
  share = from.x() / (from.x() - to.x());
  const Eigen::Vector3d at = from + share * (to - from);
  return std::hypot(at.y(), at.z()) < 0.5 * place.opening_m;
}

void WaterJet::step(double step_s, const Raycaster& scene) {
  landings_.clear();
  if (drops_.empty()) return;
  rays_.resize(drops_.size());
  hits_.resize(drops_.size());
  std::vector<Eigen::Vector3d> next(drops_.size());
  for (std::size_t i = 0; i < drops_.size(); ++i) {
    const Drop& drop = drops_[i];
    next[i] = drop.p + step_s * drop.v - Eigen::Vector3d(0, 0, 0.5 * kGravity * step_s * step_s);
    const Eigen::Vector3d way = next[i] - drop.p;
    const double length = way.norm();
    rays_[i] = {drop.p.cast<float>(), (way / std::max(1e-9, length)).cast<float>(),
                static_cast<float>(length), mask::kWater};
  }
  scene.cast(rays_, hits_, true);
  const auto landed = [&](std::size_t i) {
    for (std::size_t place = 0; place < places_.size(); ++place) {
      double share = 0.0;
      if (!throughOpening(places_[place], drops_[i].p, next[i], share)) continue;
      const bool stopped_before = hits_[i].valid() && hits_[i].range < share * rays_[i].max_range;
      if (!stopped_before) drops_[i].inside = place;
    }
    if (hits_[i].valid()) {
      const Raycaster::Ray& ray = rays_[i];
      if (drops_[i].inside && RayScene::material(hits_[i]) == Material::Plate)
        delivered_l_[*drops_[i].inside] += config_.drop_ml * 1e-3;
      landings_.push_back({hits_[i], (ray.origin + hits_[i].range * ray.direction).cast<double>()});
    }
    return hits_[i].valid() || next[i].z() < kLost_m || drops_[i].age_s > config_.max_flight_s;
  };
  std::vector<Drop> flying;
  flying.reserve(drops_.size());
  for (std::size_t i = 0; i < drops_.size(); ++i) {
    profile_.pass(drops_[i].X_map_nozzle, drops_[i].p, next[i]);
    if (landed(i)) continue;
    flying.push_back({next[i], drops_[i].v - Eigen::Vector3d(0, 0, kGravity * step_s),
                      drops_[i].age_s + step_s, drops_[i].X_map_nozzle, drops_[i].inside});
  }
  drops_ = std::move(flying);
}

std::vector<Eigen::Vector3d> WaterJet::drops() const {
  std::vector<Eigen::Vector3d> out;
  out.reserve(drops_.size());
  for (const Drop& drop : drops_) out.push_back(drop.p);
  return out;
}

}  // namespace kiln::sim
