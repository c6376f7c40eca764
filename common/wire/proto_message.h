#pragma once

#include <limits>
#include <string>
#include <string_view>

#include <google/protobuf/message_lite.h>
#include <google/protobuf/stubs/logging.h>

#include "common/core/error.h"

/// For the .cpp files of this folder alone: generated types stay out of its public headers.
namespace kiln::wire {

[[nodiscard]] inline std::string serialise(const google::protobuf::MessageLite& message) {
  return message.SerializeAsString();
}

/// @param limit largest size that is parsed at all.
template <class Message>
[[nodiscard]] Result<Message> parse(std::string_view bytes, std::size_t limit, const char* what) {
  if (bytes.size() > limit) {
    return makeError(ErrorCode::InvalidInput, "{}: {} bytes are more than {}; dropped", what,
                     bytes.size(), limit);
  }
  const google::protobuf::LogSilencer silencer;  // the Error says it; a peer must not fill our log
  Message message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return makeError(ErrorCode::InvalidInput, "{}: {} bytes cannot be parsed; dropped", what,
                     bytes.size());
  }
  return message;
}

/// An enum that travels as a number. Error when the number is above `last`.
template <class Enum>
[[nodiscard]] Result<Enum> toEnum(std::uint32_t number, Enum last, const char* what) {
  if (number > static_cast<std::uint32_t>(last)) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: {} is not a known value; do both ends run the same version?", what,
                     number);
  }
  return static_cast<Enum>(number);
}

/// Text that may hold anything (log lines, names from a shell) made valid UTF-8: proto3 refuses
/// other strings, and one bad byte must not cost the whole message.
[[nodiscard]] std::string validUtf8(std::string_view text);

}  // namespace kiln::wire
