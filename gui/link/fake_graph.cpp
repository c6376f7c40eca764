#include "gui/link/fake_robot.h"

namespace kiln::gui {

namespace {
FsmStateInfo state(const char* name, const char* label, const char* group, double limit_s = 0.0,
                   const char* timeout = "") {
  FsmStateInfo info;
  info.name = name;
  info.label = label;
  info.group = group;
  info.time_limit_s = limit_s;
  info.timeout_target = timeout;
  return info;
}

FsmStateInfo locked(FsmStateInfo info, const char* reason) {
  info.enterable = false;
  info.not_enterable_reason = reason;
  return info;
}

FsmStateInfo end(const char* name, const char* label, bool success) {
  FsmStateInfo info = state(name, label, "end");
  info.terminal = true;
  info.success = success;
  return info;
}
}  // namespace

FsmInfo makeFakeFireGraph() {
  FsmInfo info;
  info.mission = "fire";
  info.mission_uuid = "6f1c2a58-fa6e-4f1e-9c33-0f17e0000001";
  info.start_state = "WaitForStart";
  info.states = {
      state("WaitForStart", "Wait for start", "search fire"),
      state("EnterBuilding", "Enter building", "search fire", 120, "SafeStop"),
      state("NextLocation", "Next location", "search fire"),
      state("DriveToLocation", "Drive to location", "search fire", 90, "NextLocation"),
      state("ArmSearch", "Arm search", "search fire", 60, "NextLocation"),
      locked(state("HeatFound", "Heat found?", "search fire"),
             "needs the detections of an arm search"),
      locked(state("AimHose", "Aim hose", "extinguish", 45, "LostTarget"),
             "needs an estimate of the fire"),
      state("StartPump", "Start pump", "extinguish", 4, "PumpFault"),
      state("SpraySteady", "Spray steady", "extinguish", 60, "SprayPattern"),
      state("SprayPattern", "Spray pattern", "extinguish", 60, "StopPump"),
      state("StopPump", "Stop pump", "extinguish", 3, "PumpFault"),
      locked(state("LostTarget", "Lost target", "faults", 20, "NextLocation"),
             "needs the lost estimate"),
      state("PumpFault", "Pump fault", "faults", 10, "NextLocation"),
      state("ArmBlocked", "Arm blocked", "faults"),
      state("SafeStop", "Safe stop", "faults"),
      end("MissionDone", "Mission done", true),
      end("MissionFailed", "Mission failed", false),
  };
  info.edges = {
      {"WaitForStart", "EnterBuilding", false, "drives into the building"},
      {"EnterBuilding", "NextLocation", false, "robot stands at the hub"},
      {"NextLocation", "DriveToLocation", false, "drives to the next fire place"},
      {"NextLocation", "MissionDone", false, "ends the mission"},
      {"DriveToLocation", "ArmSearch", false, "arm sweeps in front of the fire box"},
      {"DriveToLocation", "NextLocation", true, "gives this place up"},
      {"ArmSearch", "HeatFound", false, "judges what the sweep saw"},
      {"HeatFound", "AimHose", false, "arm moves the nozzle to 0.9 m from the plate"},
      {"HeatFound", "NextLocation", false, "no fire here: goes on"},
      {"AimHose", "StartPump", false, "pumps start: water flows within 0.4 s"},
      {"AimHose", "LostTarget", true, "looks for the plate again"},
      {"StartPump", "SpraySteady", false, "2 l on one point"},
      {"StartPump", "PumpFault", true, "pumps off"},
      {"SpraySteady", "SprayPattern", false, "2 l in an hourglass"},
      {"SprayPattern", "StopPump", false, "pumps off"},
      {"StopPump", "NextLocation", false, "arm folds, goes on"},
      {"LostTarget", "ArmSearch", false, "arm sweeps again"},
      {"LostTarget", "NextLocation", true, "gives this place up"},
      {"PumpFault", "NextLocation", false, "goes on without this place"},
      {"AimHose", "ArmBlocked", false, "arm stands still"},
      {"ArmSearch", "ArmBlocked", false, "arm stands still"},
      {"ArmBlocked", "SafeStop", false, "waits for the operator"},
      {"ArmBlocked", "ArmSearch", false, "arm sweeps again"},
      {"EnterBuilding", "SafeStop", true, "stands still, pumps off"},
      {"SafeStop", "NextLocation", false, "goes on"},
      {"SafeStop", "MissionFailed", false, "ends the mission"},
  };
  return info;
}

std::vector<SceneBox> makeFakeArena() {
  const auto box = [](const char* name, Eigen::Vector3d p, Eigen::Vector3d size,
                      std::uint32_t rgb) {
    SceneBox b;
    b.name = name;
    b.X_map_box.translation() = p;
    b.half_extent = size / 2;
    b.rgb = rgb;
    return b;
  };
  constexpr std::uint32_t kWall = 0x9aa0a4;
  constexpr std::uint32_t kFurniture = 0x8d8470;
  constexpr std::uint32_t kFire = 0x7d95a6;
  return {box("west wall north", {5.0, 3.65, 1.5}, {0.2, 4.7, 3.0}, kWall),
          box("west wall south", {5.0, -3.65, 1.5}, {0.2, 4.7, 3.0}, kWall),
          box("east wall", {14.0, 0.0, 1.5}, {0.2, 12.0, 3.0}, kWall),
          box("north wall", {9.5, 6.0, 1.5}, {9.2, 0.2, 3.0}, kWall),
          box("south wall", {9.5, -6.0, 1.5}, {9.2, 0.2, 3.0}, kWall),
          box("pillar", {13.6, -0.3, 1.5}, {0.6, 0.6, 3.0}, kWall),
          box("kitchen counter", {9.6, 5.5, 0.45}, {2.0, 0.6, 0.9}, kFurniture),
          box("fridge", {13.4, 5.3, 0.9}, {0.7, 0.7, 1.8}, kFurniture),
          box("cupboard", {7.0, -5.5, 1.0}, {1.2, 0.5, 2.0}, kFurniture),
          box("table 1", {12.3, 2.8, 0.4}, {0.7, 0.7, 0.8}, kFurniture),
          box("fire box 1", {12.2, 2.8, 1.0}, {0.4, 0.4, 0.4}, kFire),
          box("table 2", {10.6, -4.8, 0.4}, {0.7, 0.7, 0.8}, kFurniture),
          box("fire box 2", {10.6, -4.7, 1.0}, {0.4, 0.4, 0.4}, kFire)};
}

}  // namespace kiln::gui
