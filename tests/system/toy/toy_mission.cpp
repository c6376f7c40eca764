#include "tests/system/toy/toy_mission.h"

#include <nlohmann/json.hpp>

#include "robot/fsm/machine_of.h"
#include "tests/system/toy/toy_view.h"

namespace kiln {
namespace {

using ToyMachine = MachineOf<ToyContext, ToyWait, ToyDrive, ToyDone, ToyStuck>;

constexpr double kStowed_rad = 0.035;

class ToyMission final : public Mission {
 public:
  ToyMission(const ToyConfig& config, const std::string& mission_uuid, const MissionParts& parts)
      : context_{config, {parts, kStowed_rad}, parts.pose},
        machine_({.mission = "toy", .mission_uuid = mission_uuid}, parts.clock, context_) {}

  [[nodiscard]] Machine& machine() override { return machine_; }
  void beginAnew(Stamp) override { context_.drives = 0; }
  void observe(Stamp) override {}
  void onReset(Stamp) override { context_.drive.cancel(); }
  [[nodiscard]] nlohmann::json save() const override { return {{"drives", context_.drives}}; }
  [[nodiscard]] Result<void> restore(const nlohmann::json& saved) override {
    if (!saved.contains("drives") || !saved["drives"].is_number_unsigned())
      return makeError(ErrorCode::InvalidInput, "drives is no number");
    context_.drives = saved["drives"];
    return {};
  }
  [[nodiscard]] double limitS() const override { return 60.0; }
  [[nodiscard]] std::vector<Check> checks(Stamp) const override {
    return {{"Toy", true, "wound up"}};
  }
  [[nodiscard]] std::vector<MissionAlarm> alarms(Stamp now) const override {
    if (machine_.status(now).state != "ToyStuck") return {};
    return {{"toy.stuck", AlarmLevel::Caution, "The toy is stuck", "lift it"}};
  }
  [[nodiscard]] MissionInfo info() const override { return toy::missionInfo(); }
  [[nodiscard]] Result<void> command(const MissionCommand& command, const std::string&,
                                     Stamp) override {
    context_.pushed_m += command.arguments.at(0).value;
    return {};
  }
  [[nodiscard]] std::vector<Figure> figures(Stamp) const override {
    return toy::figures(context_.drives);
  }
  void describe(Scene& scene, Stamp) const override { scene.items = toy::items(context_.goal()); }
  void report(nlohmann::json& report) const override {
    report["toy_drives"] = context_.drives;
    report["toy_x_m"] = context_.pose().x_m;
  }

 private:
  ToyContext context_;
  ToyMachine machine_;
};

}  // namespace

void ToyConfig::visit(ConfigArchive& a) {
  a.field("wait_s", wait_s, "s", 0.0, 60.0, "before it drives");
  a.field("distance_m", distance_m, "m", 0.0, 5.0, "straight ahead of the start");
}

Transition ToyWait::execute() {
  if (timeInState() < fromSeconds(context().config.wait_s)) return stay();
  return transit<ToyDrive>().because("waited");
}

void ToyDrive::enter() { context().drive.start({context().goal()}, now()); }

Transition ToyDrive::execute() {
  const SkillStatus drive = context().drive.poll(now());
  display(drive.text);
  if (drive.phase == SkillPhase::Done) return transit<ToyDone>().because("arrived");
  if (drive.phase == SkillPhase::Failed) return transit<ToyStuck>().because(drive.text);
  return stay();
}

MissionKind toyMissionKind() {
  return {"toy",
          "drives a metre",
          "fire",
          {},
          [] { return std::make_unique<MissionConfigOf<ToyConfig>>(); },
          [](const MissionConfig& config, const std::string& mission_uuid,
             const MissionParts& parts) -> Result<std::unique_ptr<Mission>> {
            return std::make_unique<ToyMission>(
                static_cast<const MissionConfigOf<ToyConfig>&>(config).value, mission_uuid, parts);
          }};
}

}  // namespace kiln
