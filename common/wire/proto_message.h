#pragma once

#include <limits>
#include <string>
#include <string_view>

#include <google/protobuf/message.h>
#include <google/protobuf/stubs/logging.h>

#include "common/core/error.h"
#include "common/core/text.h"

/// For the .cpp files of this folder alone: generated types stay out of its public headers.
namespace kiln::wire {

[[nodiscard]] inline std::string serialise(const google::protobuf::MessageLite& message) {
  return message.SerializeAsString();
}

/// No list of messages or texts is longer, however deep: whoever shows it makes an object of each
/// row. (Numbers are packed and bounded by the message's size.)
inline constexpr int kLongestList = 2000;

/// Makes every string field, however deep, one line of printable characters (core/text.h): it came
/// from outside and will be logged, shown and printed. Error: a list of more than kLongestList.
[[nodiscard]] Result<void> cleanText(google::protobuf::Message& message, const char* what);

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
  if (auto ok = cleanText(message, what); !ok) return tl::make_unexpected(ok.error());
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

}  // namespace kiln::wire
