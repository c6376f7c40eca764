#include "common/model/mission.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kiln {
const CommandSpec* MissionInfo::command(std::string_view name) const {
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [name](const CommandSpec& spec) { return spec.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

const ActuatorSpec* MissionInfo::actuator(std::string_view name) const {
  const auto found = std::find_if(actuators.begin(), actuators.end(),
                                  [name](const ActuatorSpec& spec) { return spec.name == name; });
  return found == actuators.end() ? nullptr : &*found;
}

const Figure* findFigure(const std::vector<Figure>& figures, std::string_view id) {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [id](const Figure& figure) { return figure.id == id; });
  return found == figures.end() ? nullptr : &*found;
}

std::string figureText(const FigureSpec& spec, double value) {
  if (!std::isfinite(value)) return "–";
  return fmt::format("{}{:.{}f}{}{}", spec.estimated ? "est. " : "", value, spec.decimals,
                     spec.unit.empty() ? "" : " ", spec.unit);
}

}  // namespace kiln
