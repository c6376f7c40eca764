#include "common/core/check.h"

#include <cstdlib>

#include <unistd.h>

#include "common/core/line_writer.h"

namespace kiln {
namespace {
std::function<void(const std::string&)>& failureHandler() {
  static std::function<void(const std::string&)> handler;
  return handler;
}
}  // namespace

void setCheckFailureHandler(std::function<void(const std::string&)> handler) {
  failureHandler() = std::move(handler);
}

void checkFailed(const char* file, int line, const char* condition, const std::string& values) {
  const std::string message =
      fmt::format("{}:{}: check failed: {} [{}]", file, line, condition, values);
  // First what makes the robot safe: standard error may be a pipe that nobody reads.
  if (failureHandler()) failureHandler()(message);
  constexpr Duration kLastWords = std::chrono::milliseconds(200);
  (void)writeWithin(STDERR_FILENO, message + "\n", kLastWords);
  std::abort();
}

}  // namespace kiln
