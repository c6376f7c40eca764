#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/scene.h"

/// model <-> world.proto.
namespace kiln::wire {

[[nodiscard]] std::string encode(const Scene& scene);
[[nodiscard]] Result<Scene> decodeScene(std::string_view bytes);

}  // namespace kiln::wire
