#include "gui/app/options.h"

#include <cstdio>
#include <iostream>
#include <map>

#include <CLI/CLI.hpp>

namespace kiln::gui {

std::optional<int> parseOptions(int argc, char** argv, StationOptions& options) {
  CLI::App app{
      "Operator station of Kiln: watch a robot, pause, stop, force transitions, take over.",
      "kiln-station"};
  app.set_version_flag("--version", std::string("kiln-station ") + KILN_VERSION);
  const std::map<std::string, ThemeKind> themes{{"dark", ThemeKind::Dark},
                                                {"light", ThemeKind::Light}};
  app.add_option("--connect", options.endpoint, "robot's endpoint, ipc or loopback")
      ->capture_default_str();
  app.add_option("--operator", options.operator_name, "name shown to other stations")
      ->capture_default_str();
  app.add_option("--theme", options.theme, "dark or light (key T toggles); else as it was left")
      ->transform(CLI::CheckedTransformer(themes));
  app.add_option("--screenshot", options.screenshots,
                 "save a picture at each new state and at the end into this folder");
  app.add_option("--replay", options.replay,
                 "play a recording (.mcap) in the window; nothing can be commanded");
  std::string size;
  app.add_option("--size", size,
                 "window size, WxH, at least 944x500; else as it was left, within the screen");
  app.add_flag("--exit-when-done", options.exit_when_done, "leave when the mission has ended");
  app.add_flag("--stall-report", options.stall_report,
               "print the gaps of the event loop at the end");
  app.add_option("--measure-stop", options.measure_stop,
                 "press the STOP key so often, print key to latch as JSON and leave")
      ->check(CLI::Range(1, 10000));
  app.add_flag("--take-lease", options.take_lease, "ask for the lease at start");
  app.add_flag("--flat", options.flat, "draw the scene from above, without OpenGL");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!size.empty() && (std::sscanf(size.c_str(), "%dx%d", &options.width, &options.height) != 2 ||
                        options.width < 944 || options.height < 500 || options.width > 16384 ||
                        options.height > 16384)) {
    std::cerr << "kiln-station: --size " << size
              << " is not WIDTHxHEIGHT of at least 944x500, e.g. 1680x1020\n";
    return 2;
  }
  return std::nullopt;
}

}  // namespace kiln::gui
