#include "common/config/required_keys.h"

#include <yaml-cpp/yaml.h>

#include "common/core/regular_file.h"

namespace kiln {

Result<void> requireKeys(const std::string& path, const std::vector<std::string>& keys,
                         const std::vector<std::string>& lists) {
  constexpr std::uint64_t kMostBytes = 1U << 20;
  const auto text = readRegularFile(path, kMostBytes);
  if (!text) return tl::make_unexpected(text.error());
  try {
    const YAML::Node document = YAML::Load(*text);
    const auto stands = [&](const std::string& key) {
      return document.IsMap() && document[key].IsDefined() && !document[key].IsNull();
    };
    const auto missing = [&](const std::string& key) {
      return makeError(ErrorCode::InvalidInput,
                       "{}: '{}' is missing; safety depends on it, so it has no default", path,
                       key);
    };
    for (const std::string& key : keys)
      if (!stands(key) || (document[key].IsSequence() && document[key].size() == 0))
        return missing(key);
    for (const std::string& key : lists)
      if (!stands(key)) return missing(key);
    return {};
  } catch (const YAML::Exception& e) {
    return makeError(ErrorCode::InvalidInput, "{}:{}: {}", path, e.mark.line + 1, e.msg);
  }
}

}  // namespace kiln
