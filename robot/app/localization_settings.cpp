#include "robot/app/localization_settings.h"

#include "common/config/resources.h"

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

Result<std::unique_ptr<ScanLocator>> makeLocator(const LocalizationSettings& settings,
                                                 const ArenaMap& arena) {
  if (settings.method == "walls" || settings.method == "odometry")
    return std::make_unique<WallLocator>(settings.aligner, arena);
  return makeError(ErrorCode::InvalidInput,
                   "localization.method '{}' is unknown; choose surfel_map, walls or odometry",
                   settings.method);
}

}  // namespace kiln
