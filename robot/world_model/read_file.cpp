#include "robot/world_model/read_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace kiln {

Result<std::string> readWholeFile(const std::string& path) {
  std::error_code unused;
  if (!std::filesystem::exists(path, unused))
    return makeError(ErrorCode::NotFound, "there is no file {}", path);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()) || file.bad())
    return makeError(ErrorCode::Storage, "cannot read {}: {}; check that it is a readable file",
                     path, std::strerror(errno));
  return text.str();
}

}  // namespace kiln
