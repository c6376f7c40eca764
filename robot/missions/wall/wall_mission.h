#pragma once

#include "robot/missions/common/mission_kind.h"
#include "robot/missions/wall/wall_context.h"

namespace kiln {

/// Challenge 2: plans what is built where, finds the pile and its bricks, loads them in the order of
/// building, finds the wall's marker and sets them there. Told to take fewer bricks than the plan has
/// it surveys the site and sets none. Confined to the mission thread, onPicture() aside.
class WallMission final : public Mission {
 public:
  WallMission(const MissionParts& parts, const WallConfig& config, const WallSiteMap& site,
              const WallPlan& plan, const std::string& mission_uuid);

  [[nodiscard]] Machine& machine() override { return *machine_; }
  void beginAnew(Stamp now) override;
  void observe(Stamp) override {}
  void onReset(Stamp now) override;
  [[nodiscard]] nlohmann::json save() const override;
  [[nodiscard]] Result<void> restore(const nlohmann::json& saved) override;
  [[nodiscard]] double limitS() const override { return context_.config.limit_s; }

  [[nodiscard]] MissionInfo info() const override;
  [[nodiscard]] std::vector<Figure> figures(Stamp now) const override;
  void describe(Scene& scene, Stamp now) const override;
  void report(nlohmann::json& report) const override;

  [[nodiscard]] bool wantsHeadCamera() const override { return context_.marker.listening(); }
  void onPicture(RgbImagePtr image) override { context_.marker.onPicture(std::move(image)); }

 private:
  WallContext context_;
  std::unique_ptr<Machine> machine_;
};

/// The wall mission's line in the catalogue.
[[nodiscard]] MissionKind wallMissionKind();

}  // namespace kiln
