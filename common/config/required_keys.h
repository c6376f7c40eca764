#pragma once

#include <string>
#include <vector>

#include "common/config/resources.h"
#include "common/core/error.h"

namespace kiln {

/// Every key must stand at the top of the YAML file: for what safety depends on no default is
/// believed. @param lists  keys too; a list there may say that there is none (`walls: []`), which a
/// list of `keys` may not. Error: InvalidInput, names file and key; or what readRegularFile() says.
[[nodiscard]] Result<void> requireKeys(const std::string& path,
                                       const std::vector<std::string>& keys,
                                       const std::vector<std::string>& lists = {});

/// loadResource(), and requireKeys().
template <class T>
[[nodiscard]] Result<T> loadComplete(const std::string& resource,
                                     const std::vector<std::string>& keys,
                                     const std::vector<std::string>& lists = {}) {
  const auto path = resourcePath(resource);
  if (!path) return tl::make_unexpected(path.error());
  auto loaded = loadResource<T>(resource);
  if (!loaded) return loaded;
  if (auto complete = requireKeys(*path, keys, lists); !complete)
    return tl::make_unexpected(complete.error());
  return loaded;
}

}  // namespace kiln
