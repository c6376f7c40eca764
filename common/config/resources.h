#pragma once

#include <string>

#include "common/config/config_archive.h"
#include "common/core/error.h"

namespace kiln {

/// Absolute path of a file below resources/, e.g. resourcePath("robot_model/bob.yaml"). Looked up
/// in $KILN_RESOURCES alone where that is set, else in the source tree that the program was built
/// from (<bin>/../../resources), then in <bin>/../share/kiln. Error: names each place tried.
[[nodiscard]] Result<std::string> resourcePath(const std::string& relative);

/// A config struct read from a file below resources/. Errors: those of resourcePath and loadConfig.
template <class T>
[[nodiscard]] Result<T> loadResource(const std::string& relative) {
  const auto path = resourcePath(relative);
  if (!path) return tl::make_unexpected(path.error());
  T config;
  if (auto loaded = loadConfig(*path, config); !loaded) return tl::make_unexpected(loaded.error());
  return config;
}

}  // namespace kiln
