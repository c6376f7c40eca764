#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/missions/common/mission.h"
#include "robot/missions/fire/fire_context.h"
#include "robot/missions/fire/heat_task.h"
#include "robot/missions/fire/place_task.h"

namespace kiln {

/// Challenge 3 (NimbRo UGV paper, section "Challenge 3"): finds the fire and sprays it, both places
/// one after the other. Confined to the mission thread, except onThermal().
class FireMission final : public Mission {
 public:
  /// What it makes of pictures and scans; whoever leaves them out answers for them.
  struct Perception {
    std::unique_ptr<HeatTask> heat{};    ///< nullptr: the caller hands detections to onDetections()
    std::unique_ptr<PlaceTask> place{};  ///< nullptr: FireDevices::place_look answers by itself
  };
  FireMission(const FireDevices& devices, const FireConfig& config, const std::string& mission_uuid,
              Perception perception);
  FireMission(const FireDevices& devices, const FireConfig& config, const std::string& mission_uuid)
      : FireMission(devices, config, mission_uuid, Perception{}) {}
  ~FireMission() override;

  [[nodiscard]] Machine& machine() override;
  void beginAnew(Stamp now) override;
  void observe(Stamp now) override;
  void onReset(Stamp now) override;
  [[nodiscard]] nlohmann::json save() const override;
  [[nodiscard]] Result<void> restore(const nlohmann::json& saved) override;
  [[nodiscard]] double limitS() const override;

  [[nodiscard]] MissionInfo info() const override;
  [[nodiscard]] Result<void> command(const MissionCommand& command,
                                     const std::string& operator_name, Stamp now) override;
  [[nodiscard]] MacroStepKinds macroSteps(const MacroConfig& config) const override;
  [[nodiscard]] std::optional<Pose2> workPose(const std::string& place) const override;
  [[nodiscard]] std::vector<MissionAlarm> alarms(Stamp now) const override;
  [[nodiscard]] std::vector<Check> checks(Stamp now) const override;
  [[nodiscard]] std::vector<Figure> figures(Stamp now) const override;
  void describe(Scene& scene, Stamp now) const override;
  void report(nlohmann::json& report) const override;
  void onThermal(ThermalImagePtr image) override;
  [[nodiscard]] std::uint64_t droppedFrames() const override;

  /// @param X_map_thermal  camera pose at the image's stamp.
  void onDetections(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal);
  /// The operator's correction of a place (PlaceCheck::correction() proposes one). The mission
  /// looks at the place anew. Refused while the arm works before it.
  [[nodiscard]] Result<void> nudgePlace(const std::string& place, const Pose2& by);
  /// The operator takes the responsibility: on from "Place refused" as configured. `subject` is the
  /// place's name.
  [[nodiscard]] Result<void> continueDespite(const std::string& subject,
                                             const std::string& operator_name, Stamp now);
  [[nodiscard]] const FireBelief& belief() const;
  [[nodiscard]] FireBelief& belief();
  /// Newest comparison of each place, as configured and nudged, with the live cloud.
  [[nodiscard]] std::vector<PlaceCheck> placeChecks() const;
  /// Where the places stand as it believes now.
  [[nodiscard]] const FireSiteMap& siteMap() const;
  [[nodiscard]] FireSite site(Stamp now) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
