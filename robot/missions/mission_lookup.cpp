#include <fmt/ranges.h>

#include "robot/missions/catalog.h"

namespace kiln {
namespace {

Result<SiteFixtures> fixturesOf(const ArenaMap& arena, const SiteConfig& site) {
  const MissionKind* kind = findMission(site.mission);
  if (kind && kind->site) return kind->site(arena);
  return makeError(ErrorCode::InvalidInput,
                   "arena '{}': the site {} belongs to mission '{}', which has none here: what "
                   "stands there would not be an obstacle; take it out or name it furniture",
                   arena.name, site.file, site.mission);
}

}  // namespace

const MissionKind* findMission(const std::string& name) {
  for (const MissionKind& kind : missionKinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

MissionConfigs missionConfigs() {
  std::vector<MissionConfigs::Section> sections;
  for (const MissionKind& kind : missionKinds())
    sections.push_back({kind.name, "mission " + kind.name, kind.config()});
  return MissionConfigs(std::move(sections));
}

std::string missionHelp() {
  std::vector<std::string> lines;
  for (const MissionKind& kind : missionKinds())
    lines.push_back(fmt::format("{}: {}", kind.name, kind.doc));
  return fmt::format("{}", fmt::join(lines, "; "));
}

std::vector<std::string> missionNames() {
  std::vector<std::string> names;
  for (const MissionKind& kind : missionKinds()) names.push_back(kind.name);
  return names;
}

Result<void> furnish(ArenaMap& arena) {
  for (const SiteConfig& site : arena.sites) {
    auto fixtures = fixturesOf(arena, site);
    if (!fixtures) return tl::make_unexpected(fixtures.error());
    arena.fixtures[site.mission] = std::move(*fixtures);
  }
  return {};
}

}  // namespace kiln
