#include "robot/skills/macro.h"

#include <algorithm>
#include <filesystem>

namespace kiln {
namespace {

namespace fs = std::filesystem;

/// `do` first: it says which keys the step has.
void visitStep(ConfigArchive& a, const MacroStepKinds& kinds, std::unique_ptr<MacroStep>& step) {
  std::vector<std::string> names;
  for (const MacroStepKind& kind : kinds) names.push_back(kind.name);
  std::string name;
  a.choice("do", name, names, "kind of step");
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const MacroStepKind& k) { return k.name == name; });
  if (kind == kinds.end()) return;
  step = kind->make();
  step->visit(a);
}

Result<std::vector<fs::path>> yamlFiles(const std::vector<std::string>& folders) {
  std::vector<fs::path> files;
  for (const std::string& folder : folders) {
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator(folder, ec)) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    if (ec)
      return makeError(ErrorCode::NotFound, "{}: macros cannot be read ({})", folder, ec.message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

void Macro::visit(ConfigArchive& a, const MacroStepKinds& kinds) {
  a.field("name", name, "shown in the list and given to kilnctl");
  a.field("doc", doc, "one line for the operator");
  a.field("place", place, "the base must stand at this place's work pose; empty: anywhere");
  a.field("start_tolerance_m", start_tolerance_m, "m", 0.01, 1.0, "distance from that pose");
  a.field("start_tolerance_deg", start_tolerance_deg, "deg", 0.5, 45.0, "heading off that pose");
  a.listNode(
      "steps", steps.size(),
      [this](std::size_t n) {
        steps.clear();
        steps.resize(n);
      },
      [this, &kinds](std::size_t i) {
        return ConfigNode{
            [this, &kinds, i](ConfigArchive& step) { visitStep(step, kinds, steps[i]); }};
      },
      "done in order");
}

Result<void> Macro::validate(const std::string& file) const {
  if (name.empty()) return makeError(ErrorCode::InvalidInput, "{}: 'name' is missing", file);
  if (steps.empty()) return makeError(ErrorCode::InvalidInput, "{}: 'steps' is missing", file);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string problem = steps[i] ? steps[i]->problem() : "'do' is missing";
    if (!problem.empty())
      return makeError(ErrorCode::InvalidInput, "{}: step {}: {}", file, i + 1, problem);
  }
  return {};
}

Result<std::vector<Macro>> loadMacros(const std::vector<std::string>& folders,
                                      const MacroStepKinds& kinds) {
  const auto files = yamlFiles(folders);
  if (!files) return tl::make_unexpected(files.error());
  std::vector<Macro> macros;
  for (const fs::path& file : *files) {
    Macro macro;
    const ConfigNode root{[&](ConfigArchive& a) { macro.visit(a, kinds); }};
    if (auto ok = loadYaml(file.string(), root); !ok) return tl::make_unexpected(ok.error());
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
