#include "robot/skills/macro.h"

#include <algorithm>
#include <filesystem>

namespace kiln {
namespace {
constexpr double kMaxSpray_s = 120.0;  // what the pump controller allows in one run
}

void MacroStep::visit(ConfigArchive& a) {
  a.choice("do", action, {"arm", "nozzle", "aim", "spray", "wait"}, "kind of step");
  if (action == "arm") {
    a.choice("pose", pose, {"park", "drive"}, "named pose of the robot model");
    a.field("q_deg", q_deg, "deg", -360.0, 360.0, "or six joint angles, shoulder pan to wrist 3");
  } else if (action == "nozzle") {
    a.field("xyz_m", xyz_m, "m", -2.5, 2.5, "nozzle exit in base");
    a.field("yaw_deg", yaw_deg, "deg", -180.0, 180.0, "where the nozzle looks; 0 is forward");
    a.field("pitch_deg", pitch_deg, "deg", -80.0, 80.0, "upwards positive");
  } else if (action == "aim") {
    a.field("place", place, "fire place of the arena");
    a.field("standoff_m", standoff_m, "m", 0.5, 1.2, "nozzle to plate");
  } else if (action == "spray") {
    a.field("duty", duty, "", 0.0, 1.0, "both pumps");
    a.field("seconds", seconds, "s", 0.1, kMaxSpray_s, "from switching the pumps on");
    a.choice("pattern", pattern, {"steady", "hourglass"}, "what the nozzle does meanwhile");
    if (pattern == "hourglass") {
      a.field("tilt_deg", tilt_deg, "deg", 0.1, 15.0, "of the nozzle to either side");
    }
  } else if (action == "wait") {
    a.field("seconds", seconds, "s", 0.1, 60.0, "pause");
  }
}

void Macro::visit(ConfigArchive& a) {
  a.field("name", name, "shown in the list and given to kilnctl");
  a.field("doc", doc, "one line for the operator");
  a.field("place", place, "the base must stand at this fire place's work pose; empty: anywhere");
  a.field("start_tolerance_m", start_tolerance_m, "m", 0.01, 1.0, "distance from that pose");
  a.field("start_tolerance_deg", start_tolerance_deg, "deg", 0.5, 45.0, "heading off that pose");
  a.list("steps", steps, "done in order");
}

Result<void> Macro::validate(const std::string& file) const {
  if (name.empty()) return makeError(ErrorCode::InvalidInput, "{}: 'name' is missing", file);
  if (steps.empty()) return makeError(ErrorCode::InvalidInput, "{}: 'steps' is missing", file);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const MacroStep& step = steps[i];
    const auto wrong = [&](const char* what) {
      return makeError(ErrorCode::InvalidInput, "{}: step {} ({}): {}", file, i + 1, step.action,
                       what);
    };
    if (step.action == "arm" && step.pose.empty() == step.q_deg.empty()) {
      return wrong("give either 'pose' or 'q_deg'");
    }
    if (step.action == "arm" && step.pose.empty() && step.q_deg.size() != 6) {
      return wrong("'q_deg' needs six angles");
    }
    if (step.action == "aim" && step.place.empty()) return wrong("'place' is missing");
  }
  return {};
}

Result<std::vector<Macro>> loadMacros(const std::string& folder) {
  std::error_code ec;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ec)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  if (ec) {
    return makeError(ErrorCode::NotFound, "{}: macros cannot be read ({})", folder, ec.message());
  }
  std::sort(files.begin(), files.end());
  std::vector<Macro> macros;
  for (const auto& file : files) {
    Macro macro;
    if (auto ok = loadConfig(file.string(), macro); !ok) return tl::make_unexpected(ok.error());
    if (auto ok = macro.validate(file.string()); !ok) return tl::make_unexpected(ok.error());
    const auto twin = std::find_if(macros.begin(), macros.end(),
                                   [&](const Macro& other) { return other.name == macro.name; });
    if (twin != macros.end()) {
      return makeError(ErrorCode::InvalidInput,
                       "{}: another file has a macro named '{}'; rename one", file.string(),
                       macro.name);
    }
    macros.push_back(std::move(macro));
  }
  return macros;
}

}  // namespace kiln
