#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The command line of kiln-station.
struct StationOptions {
  std::string endpoint = "tcp://127.0.0.1:7300";
  std::string operator_name = "operator";
  std::optional<ThemeKind> theme;  ///< nullopt: as the window was left
  std::string screenshots;         ///< folder; empty = none
  std::string replay;              ///< recording to play; empty = none
  int width = 0, height = 0;       ///< 0: as the window was left
  bool exit_when_done = false;
  bool stall_report = false;
  int measure_stop = 0;  ///< presses of the STOP key to time, then leave; 0 = none
  bool take_lease = false;
  bool flat = false;  ///< top view instead of 3D
};

/// Parses argv without touching a display. @return nullopt to go on, else the exit code (help and
/// version 0, bad use 2).
[[nodiscard]] std::optional<int> parseOptions(int argc, char** argv, StationOptions& options);

}  // namespace kiln::gui
