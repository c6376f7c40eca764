#include "common/core/check.h"

#include <cstdio>
#include <cstdlib>

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
  std::fprintf(stderr, "%s\n", message.c_str());
  if (failureHandler()) failureHandler()(message);
  std::abort();
}

}  // namespace kiln
