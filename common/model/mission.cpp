#include "common/model/mission.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

namespace kiln {
namespace {

auto tied(const FigureSpec& s) {
  return std::tie(s.id, s.label, s.unit, s.decimals, s.low, s.high, s.caution_below,
                  s.caution_above, s.estimated, s.top_bar, s.plot, s.doc);
}
auto tied(const LayerSpec& s) { return std::tie(s.id, s.label); }
auto tied(const ArgumentSpec& s) { return std::tie(s.name, s.unit, s.low, s.high, s.doc); }
auto tied(const ActuatorSpec& s) { return std::tie(s.name, s.text, s.low, s.high); }

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& p, const T& q) { return tied(p) == tied(q); });
}

bool sameCommands(const std::vector<CommandSpec>& a, const std::vector<CommandSpec>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const CommandSpec& p, const CommandSpec& q) {
        return std::tie(p.name, p.text, p.consequence, p.confirmation, p.while_stopped,
                        p.needs_live, p.target) == std::tie(q.name, q.text, q.consequence,
                                                            q.confirmation, q.while_stopped,
                                                            q.needs_live, q.target) &&
               same(p.arguments, q.arguments);
      });
}

}  // namespace

bool MissionInfo::operator==(const MissionInfo& o) const {
  return mission == o.mission && mission_uuid == o.mission_uuid && title == o.title &&
         panels == o.panels && same(figures, o.figures) && same(layers, o.layers) &&
         same(actuators, o.actuators) && sameCommands(commands, o.commands);
}

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
