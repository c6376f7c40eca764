#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>
#include <tl/expected.hpp>

namespace kiln {

/// What kind of expected failure this is; decides who reacts (retry, operator, give up).
enum class ErrorCode {
  InvalidInput,  ///< bad config, bad argument, bad message
  NotFound,      ///< missing file, device, name
  Unavailable,   ///< peer or device does not answer, port in use
  Refused,       ///< a command that the rules do not allow now
  Degenerate,    ///< data too poor for the algorithm
  Timeout,
  Truncated,  ///< cut-off file or packet
  VersionMismatch,
  Storage,  ///< disk full, not writable
  Fault,    ///< a device reports a fault
};
[[nodiscard]] std::string_view toString(ErrorCode code);

/// An expected failure. `message` is one sentence that says what, where and what to do.
struct Error {
  ErrorCode code = ErrorCode::InvalidInput;
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

template <class... Args>
[[nodiscard]] tl::unexpected<Error> makeError(ErrorCode code, fmt::format_string<Args...> format,
                                              Args&&... args) {
  return tl::make_unexpected(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

std::ostream& operator<<(std::ostream& out, const Error& error);

}  // namespace kiln
