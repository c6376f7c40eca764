#pragma once

#include <string>

#include "common/core/error.h"

namespace kiln {

/// Absolute path of a file below resources/, e.g. resourcePath("robot_model/bob.yaml"). Looked up
/// in $KILN_RESOURCES, then in the source tree that the running program was built from
/// (<bin>/../../resources), then in <bin>/../share/kiln. Error: names every place that was tried.
[[nodiscard]] Result<std::string> resourcePath(const std::string& relative);

}  // namespace kiln
