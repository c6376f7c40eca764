#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kiln {

/// What became of one command. UNKNOWN: no answer within 1 s; it is never sent again by itself.
enum class CommandState : std::uint8_t {
  Sent,
  Accepted,
  Refused,
  Done,
  Failed,
  Cancelled,
  Unknown,
  NotSent  ///< there was no link: said by whoever could not send it
};
[[nodiscard]] std::string_view toString(CommandState state);
struct CommandUpdate {
  std::uint64_t nonce = 0;
  std::string command;  ///< "jog_base", ...
  CommandState state = CommandState::Sent;
  std::string code;  ///< of a refusal: "no_lease", "too_old", ...
  std::string reason;
  std::string lease_holder;
  double answered_after_s = 0.0;
};

}  // namespace kiln
