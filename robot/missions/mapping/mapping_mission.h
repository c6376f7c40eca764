#pragma once

#include "robot/missions/common/mission_kind.h"
#include "robot/missions/mapping/mapping_context.h"

namespace kiln {

struct MappingConfig {
  double stow_tolerance_deg = 2.0;  ///< arm counts as in its drive pose
  double rest_s = 1.0;              ///< before a drive is tried once more
  int max_faults = 1;               ///< of the whole round
  double limit_s = 900.0;           ///< mission clock, for the operator; nothing ends by it
  void visit(ConfigArchive& a);
};

/// The mapping drive: one round along the arena's mapping path and back to where it began, arm
/// stowed, so that the map made of its recording closes a loop. Needs no map: locate by walls.
/// Confined to the mission thread.
class MappingMission final : public Mission {
 public:
  MappingMission(const MappingConfig& config, const std::string& mission_uuid,
                 const MissionParts& parts);

  [[nodiscard]] Machine& machine() override { return *machine_; }
  void beginAnew(Stamp now) override;
  void observe(Stamp) override {}
  void onReset(Stamp now) override;
  [[nodiscard]] nlohmann::json save() const override;
  [[nodiscard]] Result<void> restore(const nlohmann::json& saved) override;
  [[nodiscard]] double limitS() const override { return limit_s_; }

 private:
  double limit_s_;
  StowedDrive drive_;
  MappingContext context_;
  std::unique_ptr<Machine> machine_;
};

/// The mapping drive's line in the catalogue.
[[nodiscard]] MissionKind mappingMissionKind();

}  // namespace kiln
