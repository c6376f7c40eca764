#pragma once

#include <functional>
#include <string>

#include <fmt/format.h>

namespace kiln {

/// Called with the message before the process ends through a failed KILN_CHECK. kiln-robotd sets it
/// to the safe stop (pumps off, base stopped). Must not throw and must not allocate locks held by
/// the failing thread.
void setCheckFailureHandler(std::function<void(const std::string&)> handler);

[[noreturn]] void checkFailed(const char* file, int line, const char* condition,
                              const std::string& values);

namespace detail {
template <class... Ts>
std::string joinValues(const Ts&... values) {
  std::string out;
  ((out += fmt::format("{}{}", out.empty() ? "" : ", ", values)), ...);
  return out;
}
}  // namespace detail

}  // namespace kiln

/// Our own bugs only, always on; never on input. Ends in the safe stop.
#define KILN_CHECK(condition, ...)                                  \
  do {                                                              \
    if (!(condition)) [[unlikely]]                                  \
      ::kiln::checkFailed(__FILE__, __LINE__, #condition,           \
                          ::kiln::detail::joinValues(__VA_ARGS__)); \
  } while (false)
