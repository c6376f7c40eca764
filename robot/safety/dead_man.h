#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/config_archive.h"
#include "common/model/command.h"

namespace kiln {

/// What runs only while it is held.
enum class HoldKind : std::uint8_t { BaseJog, ArmJog, Actuator, Macro };
inline constexpr std::size_t kHoldKinds = 4;
[[nodiscard]] std::string_view toString(HoldKind kind);
/// nullopt for anything that is not a hold-to-run setpoint (ReleaseAll included).
[[nodiscard]] std::optional<HoldKind> holdKind(const CommandBody& body);
/// A setpoint that asks for nothing: the zero of a release edge, an empty macro name, ReleaseAll.
[[nodiscard]] bool isRelease(const CommandBody& body);

/// Follows the hold-to-run setpoints of each kind: 250 ms after the last one, an explicit release
/// or releaseAll() the kind counts as released, whatever happens to the sender. A hold belongs to
/// one press of a control (Command::press): once it has ended the same press, and every earlier one
/// of that client, moves nothing any more, so that only a new deliberate act does (IEC 62745).
/// Confined to the mission thread.
class DeadMan {
 public:
  struct Config {
    double timeout_s = 0.25;
    void visit(ConfigArchive& a);
  };
  explicit DeadMan(Config config) : config_(config) {}

  /// Ends what was heard of too long ago. To be called before a batch of commands is looked at:
  /// what the robot did not see in time is over, even if it waited in a queue.
  void expire(Stamp now);
  /// Does the press of this setpoint still count? A release always does.
  [[nodiscard]] bool mayFeed(const Command& command) const;
  /// An accepted setpoint, received at `when`. @pre mayFeed
  void feed(const Command& command, Stamp when);
  /// A setpoint that was refused: its press is over, unless it holds already and only this message
  /// was late, repeated or overtaken.
  void refused(const Command& command, bool only_this_message);
  /// The work behind this hold has ended or could not begin: let go and press again.
  void end(HoldKind kind);
  /// Ends every hold, and every press that was heard of.
  void releaseAll();
  [[nodiscard]] bool held(HoldKind kind, Stamp now) const;
  [[nodiscard]] bool anyHeld(Stamp now) const;
  /// The kinds whose hold has ended since the last call: each release edge once.
  [[nodiscard]] std::vector<HoldKind> takeReleased(Stamp now);

 private:
  struct Hold {
    std::optional<Stamp> last;  ///< nullopt: released
    std::string client;
    std::uint64_t press = 0;
    bool reported = true;  ///< its release edge has been taken
  };
  struct Client {
    std::uint64_t newest = 0;                      ///< press heard of
    std::array<std::uint64_t, kHoldKinds> over{};  ///< newest press of each kind that has ended
    std::uint64_t touched = 0;
  };
  Client& client(const std::string& id);
  Config config_;
  std::map<std::string, Client> clients_;  ///< bounded: the one that was silent longest goes
  std::uint64_t touches_ = 0;
  std::array<Hold, kHoldKinds> holds_;
};

}  // namespace kiln
