#pragma once

#include <functional>
#include <string>

#include "gui/ctl/console.h"

/// The subcommands; each returns the exit code.
namespace kiln::ctl {

[[nodiscard]] int showState(Console& console);
/// Prints a line every `period_s` until a signal or `seconds` are over (0: no end).
[[nodiscard]] int watch(Console& console, double period_s, double seconds);
[[nodiscard]] int listMacros(Console& console);
[[nodiscard]] int listAlarms(Console& console);
[[nodiscard]] int showMission(Console& console);
/// A command that the mission has described. @param arguments  "x=0.1"; those left out are 0.
[[nodiscard]] int missionCommand(Console& console, const std::string& name,
                                 const std::string& target,
                                 const std::vector<std::string>& arguments);
/// Takes control, sends, waits for the answer, gives control back.
[[nodiscard]] int showLocalization(Console& console);
[[nodiscard]] int commandWithControl(Console& console, CommandBody body);
[[nodiscard]] int clearStop(Console& console);
/// @param from  empty: the state that the robot is in now.
[[nodiscard]] int transition(Console& console, const std::string& from, const std::string& to);
/// Keeps control until a signal or `seconds` are over.
[[nodiscard]] int keepControl(Console& console, double seconds);
[[nodiscard]] int stopRobot(Console& console);

/// Hold-to-run: streams the setpoint at 25 Hz until a signal or `seconds` are over (0: a signal),
/// then zero three times and silence.
[[nodiscard]] int holdSetpoint(Console& console, const CommandBody& setpoint, double seconds);
/// Holds a macro until it has ended; a signal releases and so cancels it.
[[nodiscard]] int runMacro(Console& console, const std::string& name, bool restart);

}  // namespace kiln::ctl
