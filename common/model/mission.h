#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/stamp.h"

namespace kiln {

/// A number that a mission tells: how it is shown. The value travels in RobotStatus::figures.
struct FigureSpec {
  std::string id;     ///< "water.left"
  std::string label;  ///< "Water"
  std::string unit;   ///< "l"; may be empty
  int decimals = 1;
  double low = 0.0, high = 0.0;  ///< of its bar; least range of its plot; equal: neither
  std::optional<double> caution_below{}, caution_above{};
  bool estimated = false;  ///< a model's word, not a measurement; said wherever it is shown
  bool top_bar = false;    ///< important enough for the top bar
  bool plot = false;       ///< drawn over time
  std::string doc{};       ///< one sentence for the tooltip and kilnctl
  bool operator==(const FigureSpec&) const = default;
};
struct Figure {
  std::string id;
  double value = 0.0;  ///< NaN: not known
  double age_s = 0.0;
};
[[nodiscard]] const Figure* findFigure(const std::vector<Figure>& figures, std::string_view id);
/// "est. 4.2 l"; "–" for a value that is not known.
[[nodiscard]] std::string figureText(const FigureSpec& spec, double value);

/// A layer of the scene that a mission draws in (SceneItem::layer).
struct LayerSpec {
  std::string id;     ///< "fire.places"
  std::string label;  ///< "Fire places"
  bool operator==(const LayerSpec&) const = default;
};

/// How much an operator must do to give a command (console.md item 14, classes A to D).
enum class Confirmation : std::uint8_t { None, Click, Hold, TwoSteps };

struct ArgumentSpec {
  std::string name;  ///< "yaw"
  std::string unit;  ///< "deg"
  double low = 0.0, high = 0.0;
  std::string doc{};
  bool operator==(const ArgumentSpec&) const = default;
};

/// A command of one mission, so described that the gate can judge it and a station can offer it.
/// Every one needs the lease.
struct CommandSpec {
  std::string name;         ///< "nudge_place"
  std::string text;         ///< on a key: "Move place"
  std::string consequence;  ///< one sentence: what the robot does then
  Confirmation confirmation = Confirmation::Click;
  bool while_stopped = false;  ///< moves nothing: passes under a latched STOP
  bool needs_live = false;     ///< only while the mission is running or held
  std::string target{};        ///< what it is given to: "place"; empty: to nothing
  std::vector<ArgumentSpec> arguments{};
  bool operator==(const CommandSpec&) const = default;
};

/// Something that runs while it is held (HoldActuator).
struct ActuatorSpec {
  std::string name;  ///< "pumps"
  std::string text;
  double low = 0.0, high = 1.0;
  bool operator==(const ActuatorSpec&) const = default;
};

inline constexpr const char* kPumps = "pumps";  ///< both at once
inline constexpr const char* kPumpLeft = "pump_left";
inline constexpr const char* kPumpRight = "pump_right";

/// What a mission brings, told once to each station.
struct MissionInfo {
  std::string mission;       ///< name in the catalogue: "fire"
  std::string mission_uuid;  ///< of this run
  std::string title;         ///< "Fire in the kitchen"
  std::vector<FigureSpec> figures;
  std::vector<LayerSpec> layers;
  std::vector<CommandSpec> commands;
  std::vector<ActuatorSpec> actuators;  ///< of the robot
  std::vector<std::string> panels;      ///< ids of the station's panels that belong to it
  bool operator==(const MissionInfo&) const = default;
  [[nodiscard]] const CommandSpec* command(std::string_view name) const;    ///< nullptr: none
  [[nodiscard]] const ActuatorSpec* actuator(std::string_view name) const;  ///< nullptr: none
};

/// A message of one mission's own schema, for its own panels.
struct MissionDetail {
  Stamp stamp;
  std::string schema;  ///< "kiln.fire.v1.FireSite"; empty: nothing
  std::string data;
};

}  // namespace kiln
