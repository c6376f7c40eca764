#include "robot/sim/storage_device.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kiln::sim {
namespace {

constexpr double kStiffness = 20.0;     ///< rad/s, of the position loop
constexpr double kJamStiffness = 60.0;  ///< rad/s, of what holds a jammed one
constexpr double kLoad_kg = 30.0;       ///< compartment with half its bricks; the loop's guess
constexpr double kStill_mps = 0.004, kMoving_mps = 0.002;

}  // namespace

StorageDevice::StorageDevice(const StorageDeviceConfig& config,
                             const std::vector<CompartmentConfig>& rows, std::uint64_t seed)
    : config_(config), rows_(rows), drives_(rows.size()), noise_(seed, "storage current") {}

std::string StorageDevice::write(Stamp now, const std::vector<double>& targets_m) {
  if (targets_m.size() != drives_.size())
    return fmt::format("{} storage targets for {} compartments", targets_m.size(), drives_.size());
  for (std::size_t i = 0; i < targets_m.size(); ++i) {
    const CompartmentConfig& row = rows_[i];
    if (!(targets_m[i] >= row.travel_min_m && targets_m[i] <= row.travel_max_m))  // also NaN
      return fmt::format("target {:.3f} m of compartment '{}' lies outside {:.3f} to {:.3f} m",
                         targets_m[i], row.name, row.travel_min_m, row.travel_max_m);
  }
  written_ = now;
  ever_ = true;
  lost_ = false;
  for (std::size_t i = 0; i < targets_m.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.blocked && targets_m[i] == drive.target_m) continue;
    drive.target_m = targets_m[i];
    drive.blocked = false;
  }
  return {};
}

/// Trapezoid: up to speed, and down in time to stand at the target.
void StorageDevice::advance(Drive& drive, const CompartmentConfig& row, double step_s) const {
  const bool rests = lost_ || !ever_ || drive.blocked || !powered_;
  const double rest = drive.target_m - drive.at_m;
  const double most =
      std::min(row.speed_mps, std::sqrt(2.0 * config_.accel_mps2 * std::fabs(rest)));
  const double wanted = rests ? 0.0 : std::copysign(most, rest);
  const double reach = config_.accel_mps2 * step_s;
  drive.speed_mps += std::clamp(wanted - drive.speed_mps, -reach, reach);
  double next = drive.at_m + drive.speed_mps * step_s;
  if (!rests && (drive.target_m - next) * rest <= 0.0 &&
      std::fabs(drive.speed_mps) <= 2.0 * reach) {
    next = drive.target_m;
    drive.speed_mps = 0.0;
  }
  drive.at_m = next;
}

void StorageDevice::control(Stamp now, double step_s, Physics& physics) {
  if (ever_ && toSeconds(now - written_) > config_.watchdog_s) lost_ = true;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    const JointState joint = physics.compartment(i);
    advance(drive, rows_[i], step_s);
    const double w = kStiffness, m = kLoad_kg;
    drive.push_n = std::clamp(
        m * w * (w * (drive.at_m - joint.position) + 2.0 * (drive.speed_mps - joint.velocity)),
        -config_.belt_n, config_.belt_n);
    const bool strains =
        std::fabs(drive.push_n) > 0.9 * config_.belt_n && std::fabs(joint.velocity) < kStill_mps;
    drive.stuck_s = strains ? drive.stuck_s + step_s : 0.0;
    if (drive.stuck_s >= config_.jam_s) {
      drive.blocked = true;
      drive.at_m = joint.position;
      drive.speed_mps = drive.stuck_s = 0.0;
    }
    double lock_n = 0.0;
    if (!drive.jam) drive.jammed_at_m.reset();
    if (drive.jam) {
      if (!drive.jammed_at_m) drive.jammed_at_m = joint.position;
      const double j = kJamStiffness;
      lock_n = m * j * (j * (*drive.jammed_at_m - joint.position) - 2.0 * joint.velocity);
    }
    physics.setCompartmentForce(i, drive.push_n + lock_n);
  }
}

StorageState StorageDevice::report(Stamp now, const Physics& physics) {
  StorageState state;
  state.stamp = now;
  state.setpoint_lost = lost_;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const JointState joint = physics.compartment(i);
    const double current = config_.idle_a + config_.amperes_per_n * std::fabs(drives_[i].push_n) +
                           noise_.normal(config_.current_noise_a);
    state.compartments.push_back({joint.position, drives_[i].target_m, std::max(0.0, current),
                                  std::fabs(joint.velocity) > kMoving_mps, drives_[i].blocked});
  }
  return state;
}

}  // namespace kiln::sim
