#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/core/error.h"
#include "common/model/command.h"
#include "common/model/scene.h"
#include "common/model/sensor.h"
#include "common/model/status.h"
#include "robot/fsm/machine.h"
#include "robot/skills/macro_steps.h"

namespace kiln {

/// An alarm that a mission raises while it is listed.
struct MissionAlarm {
  std::string id;
  AlarmLevel level = AlarmLevel::Advisory;
  std::string text;
  std::string action;  ///< what the operator should do
};

/// What one mission brings: its states, what it knows, what it makes of the sensors, what it tells
/// and what it may be asked. MissionHost runs it; it is made by the catalogue
/// (robot/missions/catalog.h). Confined to the mission thread, except onThermal().
class Mission {
 public:
  virtual ~Mission() = default;

  [[nodiscard]] virtual Machine& machine() = 0;
  /// A mission after another begins: forgets what it did. Before the machine starts.
  virtual void beginAnew(Stamp now) = 0;
  /// Once a tick, before the machine steps: takes over what devices and perception say.
  virtual void observe(Stamp now) = 0;
  /// The robot was carried to its start: everything rests, knowledge stays.
  virtual void onReset(Stamp now) = 0;
  /// What it knows, for the checkpoint.
  [[nodiscard]] virtual nlohmann::json save() const = 0;
  /// Error: InvalidInput, names what is wrong; nothing was taken over then.
  [[nodiscard]] virtual Result<void> restore(const nlohmann::json& saved) = 0;
  /// Length of the mission clock, s; 0: none.
  [[nodiscard]] virtual double limitS() const = 0;

  /// What it brings to the station; fixed for its life. Who runs it adds its name and the run.
  [[nodiscard]] virtual MissionInfo info() const;
  /// A command that info() describes; the gate has judged it by that. Error: Refused or
  /// InvalidInput.
  [[nodiscard]] virtual Result<void> command(const MissionCommand& command,
                                             const std::string& operator_name, Stamp now);
  /// Kinds of macro steps that it brings; the mission outlives them.
  [[nodiscard]] virtual MacroStepKinds macroSteps(const MacroConfig& config) const;
  /// Where the base works on a place that a macro names; nullopt: there is none of that name.
  [[nodiscard]] virtual std::optional<Pose2> workPose(const std::string& place) const;
  /// Raised now. @pre observe() was called in this tick.
  [[nodiscard]] virtual std::vector<MissionAlarm> alarms(Stamp now) const;
  /// Rows of the preflight that this mission adds.
  [[nodiscard]] virtual std::vector<Check> checks(Stamp now) const;
  /// The values of info()'s figures.
  [[nodiscard]] virtual std::vector<Figure> figures(Stamp now) const;
  /// Adds what it draws.
  virtual void describe(Scene& scene, Stamp now) const;
  /// Adds its keys to the mission report.
  virtual void report(nlohmann::json& report) const;

  /// A thermal image has arrived; any thread.
  virtual void onThermal(ThermalImagePtr image);
  /// Whether pictures of the head camera are needed now: they cost so much that it rests else.
  [[nodiscard]] virtual bool wantsHeadCamera() const { return false; }
  /// A picture of the head camera has arrived, wanted here or by a station; any thread.
  virtual void onPicture(RgbImagePtr image);
  /// Frames that its perception could not take.
  [[nodiscard]] virtual std::uint64_t droppedFrames() const { return 0; }
};

}  // namespace kiln
