#pragma once

#include <functional>
#include <optional>

#include "robot/sim/pump_device.h"
#include "robot/sim/water_jet.h"
#include "robot/sim/wet_boards.h"
#include "robot/sim/world_part.h"

namespace kiln::sim {

/// The fire places: a plate that burns from the mission's clock on, the water of the robot's pumps
/// and where it lands (scenario.md sections 2 and 3).
class FirePart final : public WorldPart {
 public:
  /// @param arena, robot, pumps  outlive it.
  FirePart(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot,
           PumpDevice& pumps, std::uint64_t seed);

  void startClock(Stamp now) override;
  void step(Stamp now, double step_s, const Physics& physics, SensorSuite& sensors,
            const SceneState& scene) override;
  void show(SceneState& state, Stamp now) const override;
  void tell(Truth& truth) const override;

  [[nodiscard]] const WetBoards& wet() const { return wet_; }
  [[nodiscard]] std::vector<Eigen::Vector3d> drops() const { return jet_.drops(); }

 private:
  [[nodiscard]] double plateTemperature(Stamp now) const;  ///< of the burning one, degC
  [[nodiscard]] Eigen::Isometry3d nozzle(const Eigen::Isometry3d& X_map_base,
                                         const Vector6d& q) const;

  FireConfig config_;
  const TrueArena& arena_;
  const RobotGeometry& robot_;
  PumpDevice& pumps_;
  WaterJet jet_;
  WetBoards wet_;
  std::optional<Stamp> lit_;
};

}  // namespace kiln::sim
