#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "common/config/config_archive.h"
#include "common/model/command.h"

namespace kiln {

/// What runs only while it is held.
enum class HoldKind : std::uint8_t { BaseJog, ArmJog, Pump, Macro };
inline constexpr std::size_t kHoldKinds = 4;
[[nodiscard]] std::string_view toString(HoldKind kind);
/// nullopt for anything that is not a hold-to-run setpoint (ReleaseAll included).
[[nodiscard]] std::optional<HoldKind> holdKind(const CommandBody& body);
/// A setpoint that asks for nothing: the zero of a release edge, an empty macro name, ReleaseAll.
[[nodiscard]] bool isRelease(const CommandBody& body);

/// Follows the hold-to-run setpoints of each kind: 250 ms after the last one, an explicit zero or
/// releaseAll() the kind counts as released, whatever happens to the sender. Confined to the
/// mission thread.
class DeadMan {
 public:
  struct Config {
    double timeout_s = 0.25;
    void visit(ConfigArchive& a);
  };
  explicit DeadMan(Config config) : config_(config) {}

  /// An accepted setpoint, received at `when`.
  void feed(const CommandBody& setpoint, Stamp when);
  void releaseAll();
  [[nodiscard]] bool held(HoldKind kind, Stamp now) const;
  [[nodiscard]] bool anyHeld(Stamp now) const;
  /// The kinds whose hold has ended since the last call: each release edge once.
  [[nodiscard]] std::vector<HoldKind> takeReleased(Stamp now);

 private:
  struct Hold {
    std::optional<Stamp> last;  ///< nullopt: released
    bool reported = true;       ///< its release edge has been taken
  };
  Config config_;
  std::array<Hold, kHoldKinds> holds_;
};

}  // namespace kiln
