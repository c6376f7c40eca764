#pragma once

#include <memory>
#include <string>

#include "robot/localization/localizer.h"
#include "robot/localization/scan_locator.h"

namespace kiln {

/// How the robot finds out where it is.
struct LocalizationSettings {
  std::string method = "walls";  ///< "surfel_map", "walls" (no map needed, level floor), "odometry"
  std::string map = "maps/kitchen.map";  ///< resource, of kiln-eval map
  Localizer::Config localizer;
  ScanMatcher::Config matcher;
  BoxMapAligner::Config aligner;
  void visit(ConfigArchive& a);
  [[nodiscard]] Localizer::Config localizerConfig() const;  ///< as the method wants it
};

/// Error: InvalidInput for an unknown method; what loading the map says.
[[nodiscard]] Result<std::unique_ptr<ScanLocator>> makeLocator(const LocalizationSettings& settings,
                                                               const ArenaMap& arena);

}  // namespace kiln
