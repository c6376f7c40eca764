#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/robot_model/storage_geometry.h"
#include "robot/hal/storage.h"
#include "robot/sim/physics.h"
#include "robot/sim/random.h"

namespace kiln::sim {

/// The compartments' belt drives: each follows a ramp to its target, stops when no target comes any
/// more, and rests blocked where it pushes in vain. Thread-compatible.
class StorageDevice {
 public:
  StorageDevice(const StorageDeviceConfig& config, const std::vector<CompartmentConfig>& rows,
                std::uint64_t seed);

  /// @return empty, or why it was refused.
  std::string write(Stamp now, const std::vector<double>& targets_m);
  /// Something holds this compartment fast where it is.
  void setJammed(std::size_t compartment, bool jammed) { drives_[compartment].jam = jammed; }
  void setPowered(bool powered) { powered_ = powered; }
  /// Before each physics step.
  void control(Stamp now, double step_s, Physics& physics);
  [[nodiscard]] StorageState report(Stamp now, const Physics& physics);
  [[nodiscard]] std::size_t size() const { return drives_.size(); }

 private:
  struct Drive {
    double target_m = 0.0, at_m = 0.0, speed_mps = 0.0;  ///< wanted; the ramp
    double push_n = 0.0, stuck_s = 0.0;
    bool blocked = false, jam = false;
    std::optional<double> jammed_at_m;
  };
  void advance(Drive& drive, const CompartmentConfig& row, double step_s) const;

  StorageDeviceConfig config_;
  std::vector<CompartmentConfig> rows_;
  std::vector<Drive> drives_;
  Random noise_;
  Stamp written_;
  bool ever_ = false, lost_ = false, powered_ = true;
};

}  // namespace kiln::sim
