#include "robot/app/localization_settings.h"

#include "common/config/resources.h"
#include "robot/localization/surfel_map_file.h"

namespace kiln {

void LocalizationSettings::visit(ConfigArchive& a) {
  a.field("method", method,
          "surfel_map: scans against the map below; walls: against the nominal walls of the arena; "
          "odometry: no scans at all, to compare with");
  a.field("map", map, "resource file written by kiln-eval map");
  a.section("localizer", localizer, "choice of the map, the way back when lost");
  a.section("matcher", matcher, "scan against the surfel map");
  a.section("aligner", aligner, "scan against the nominal walls");
}

Localizer::Config LocalizationSettings::localizerConfig() const {
  Localizer::Config config = localizer;
  config.tracker.odometry_only = config.tracker.odometry_only || method == "odometry";
  return config;
}

namespace {

/// The planar surfels of both maps at their finest level, thinned to what a station draws.
std::shared_ptr<const MapLayer> drawn(const LocalizationMap& map) {
  auto layer = std::make_shared<MapLayer>();
  layer->name = map.arena;
  layer->version = map.checksum;
  for (std::size_t part = 0; part < map.segments.size(); ++part) {
    layer->submaps.push_back(map.segments[part].name);
    for (const Surfel& surfel : map.segments[part].map->surfels(0)) {
      if (layer->points_map.size() == kMaxMapLayerPoints) return layer;
      layer->points_map.push_back(surfel.mean);
      layer->submap_of.push_back(static_cast<std::uint8_t>(part));
    }
  }
  return layer;
}

Result<Location> fromMap(const LocalizationSettings& settings, const ArenaMap& arena) {
  auto file = resourcePath(settings.map);
  if (!file) return tl::make_unexpected(file.error());
  auto map = loadMap(*file);
  if (!map) return tl::make_unexpected(map.error());
  if (map->arena != arena.name) {
    return makeError(ErrorCode::InvalidInput,
                     "{} is a map of '{}', the arena is '{}'; make one with kiln-eval map", *file,
                     map->arena, arena.name);
  }
  const SurfelLocator::Maps parts{map->find("outdoor"), map->find("indoor")};
  if (!parts[0] || !parts[1]) {
    return makeError(ErrorCode::InvalidInput,
                     "{} lacks its outdoor or its indoor part; make it anew with kiln-eval map",
                     *file);
  }
  return Location{std::make_unique<SurfelLocator>(settings.matcher, parts), drawn(*map)};
}

}  // namespace

Result<Location> makeLocation(const LocalizationSettings& settings, const ArenaMap& arena) {
  if (settings.method == "surfel_map") return fromMap(settings, arena);
  if (settings.method == "walls" || settings.method == "odometry")
    return Location{std::make_unique<WallLocator>(settings.aligner, arena), nullptr};
  return makeError(ErrorCode::InvalidInput,
                   "localization.method '{}' is unknown; choose surfel_map, walls or odometry",
                   settings.method);
}

}  // namespace kiln
