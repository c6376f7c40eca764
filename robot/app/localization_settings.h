#pragma once

#include <memory>
#include <string>

#include "common/model/localization.h"
#include "robot/localization/localizer.h"
#include "robot/localization/scan_locator.h"

namespace kiln {

/// How the robot finds out where it is.
struct LocalizationSettings {
  std::string method =
      "surfel_map";  ///< or "walls" (no map needed, level floor), "odometry" (to compare with)
  std::string map = "maps/kitchen.map";  ///< resource, of kiln-eval map
  Localizer::Config localizer;
  ScanMatcher::Config matcher;
  BoxMapAligner::Config aligner;
  void visit(ConfigArchive& a);
  [[nodiscard]] Localizer::Config localizerConfig() const;  ///< as the method wants it
};

struct Location {
  std::unique_ptr<ScanLocator> locator;
  std::shared_ptr<const MapLayer> layer;  ///< the map to draw; null without a map
};
/// Error: InvalidInput for an unknown method, a map of another arena or one without its two parts;
/// what loading the map says.
[[nodiscard]] Result<Location> makeLocation(const LocalizationSettings& settings,
                                            const ArenaMap& arena);

}  // namespace kiln
