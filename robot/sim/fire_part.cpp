#include "robot/sim/fire_part.h"

#include <algorithm>
#include <cmath>

#include "robot/sim/physics.h"
#include "robot/sim/sensor_suite.h"

namespace kiln::sim {

FirePart::FirePart(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
                   PumpDevice& pumps, std::uint64_t seed)
    : config_(config.fire),
      arena_(arena),
      robot_(robot),
      pumps_(pumps),
      jet_(config.water, arena.fire_places, seed),
      wet_(config.warm_boards, arena) {
  if (config_.lit_at_start) lit_ = Stamp{};
}

void FirePart::startClock(Stamp now) {
  if (!lit_) lit_ = now;
}

double FirePart::plateTemperature(Stamp now) const {
  if (!lit_) return config_.ambient_c;
  const double burns_s = toSeconds(now - *lit_);
  return config_.ambient_c + config_.rise_k * (1.0 - std::exp(-burns_s / config_.time_constant_s));
}

Eigen::Isometry3d FirePart::nozzle(const Eigen::Isometry3d& X_map_base, const Vector6d& q) const {
  return X_map_base * robot_.X_base_flange(q) * arena_.robot.X_flange_nozzle;
}

void FirePart::step(Stamp now, double step_s, const Physics& physics, SensorSuite& sensors,
                    const SceneState& scene) {
  const double litres = pumps_.step(now, step_s);
  if (litres > 0.0) {
    const Eigen::Isometry3d X_map_nozzle = nozzle(scene.X_map_base, scene.q);
    jet_.emit(litres, pumps_.flowFraction(), X_map_nozzle,
              physics.flangePointVelocity(X_map_nozzle.translation()));
  }
  if (!jet_.flying()) return;
  jet_.step(step_s, sensors.rays(scene));
  if (wet_.empty()) return;
  for (const WaterJet::Landing& landing : jet_.landings()) {
    if (const auto box = sensors.boxHit(landing.on); box) wet_.land(*box, landing.p_map, now);
  }
}

void FirePart::show(SceneState& state, Stamp now) const { state.plate_c = plateTemperature(now); }

void FirePart::tell(Truth& truth) const {
  FireTruth& t = truth.fire;
  t.litres_delivered = jet_.deliveredLitres();
  t.burning = arena_.burning;
  if (!t.litres_delivered.empty())
    truth.score +=
        config_.points * std::min(1.0, t.litres_delivered[t.burning] / config_.full_score_l);
  t.pump_on_s = pumps_.onTime();
  t.litres_emitted = jet_.emittedLitres();
  t.jet_profile = jet_.profile().rows();
  for (std::size_t i = 0; i < 2; ++i) {
    t.tank_l[i] = pumps_.tank(i);
    t.full_flow_lpm[i] = pumps_.fullFlow(i);
  }
  t.X_map_nozzle = nozzle(truth.X_map_base, truth.q);
  t.jet_on = pumps_.flowFraction() > 0.0;
  t.plate_c = plateTemperature(truth.now);
}

}  // namespace kiln::sim
