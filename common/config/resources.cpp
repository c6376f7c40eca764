#include "common/config/resources.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include <fmt/ranges.h>

namespace kiln {

Result<std::string> resourcePath(const std::string& relative) {
  namespace fs = std::filesystem;
  std::error_code ec;
  std::vector<std::string> tried;
  std::vector<fs::path> roots;
  if (const char* env = std::getenv("KILN_RESOURCES")) {
    roots.emplace_back(env);  // and no other: half of it from elsewhere would be another robot
  } else {
    const fs::path program = fs::read_symlink("/proc/self/exe", ec).parent_path();
    for (const char* up : {"../resources", "../../resources", "../../../resources"})
      roots.push_back(program / up);
    roots.push_back(program / "../share/kiln");
    roots.push_back(KILN_RESOURCE_DIR);
  }
  for (const fs::path& root : roots) {
    const fs::path path = (root / relative).lexically_normal();
    if (fs::exists(path, ec)) return path.string();
    tried.push_back(path.string());
  }
  return makeError(
      ErrorCode::NotFound,
      "resource '{}' not found; tried {}; set KILN_RESOURCES to Kiln's resources folder", relative,
      fmt::join(tried, ", "));
}

}  // namespace kiln
