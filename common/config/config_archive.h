#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln {

class ConfigArchive;

/// Any plain struct with `void visit(ConfigArchive&)`, seen through one virtual call so that
/// visitors need no templates in headers.
struct ConfigNode {
  std::function<void(ConfigArchive&)> visit;
};

/// The one visitor of configuration. A config struct has defaults and, in its .cpp,
///   void BaseConfig::visit(ConfigArchive& a) {
///     a.field("max_speed_mps", max_speed_mps, "m/s", 0.0, 4.0, "speed limit");
///     a.section("limits", limits, "what the base may do");
///   }
/// which yields loading with file:line errors, validation, a dump of the effective values and the
/// reference table. A range is [min, max], inclusive; NaN is always out of range.
class ConfigArchive {
 public:
  virtual ~ConfigArchive() = default;
  virtual void field(const char* name, double& value, const char* unit, double min, double max,
                     const char* doc) = 0;
  virtual void field(const char* name, int& value, const char* unit, int min, int max,
                     const char* doc) = 0;
  virtual void field(const char* name, bool& value, const char* doc) = 0;
  virtual void field(const char* name, std::string& value, const char* doc) = 0;
  /// A text that must be one of a few words.
  virtual void choice(const char* name, std::string& value, const std::vector<std::string>& allowed,
                      const char* doc) {
    static_cast<void>(allowed);
    field(name, value, doc);
  }
  /// Fixed length: the YAML list must have exactly value.size() entries when size > 0 and `fixed`.
  virtual void field(const char* name, std::vector<double>& value, const char* unit, double min,
                     double max, const char* doc, bool fixed = true) = 0;
  virtual void sectionNode(const char* name, const ConfigNode& node, const char* doc) = 0;
  /// A list of like items: `resize(n)` is called once when loading, then `item(i)` for each.
  virtual void listNode(const char* name, std::size_t size,
                        const std::function<void(std::size_t)>& resize,
                        const std::function<ConfigNode(std::size_t)>& item, const char* doc) = 0;

  template <class T>
  void section(const char* name, T& value, const char* doc) {
    sectionNode(name, ConfigNode{[&value](ConfigArchive& a) { value.visit(a); }}, doc);
  }
  template <class T>
  void list(const char* name, std::vector<T>& values, const char* doc) {
    listNode(
        name, values.size(), [&values](std::size_t n) { values.assign(n, T{}); },
        [&values](std::size_t i) {
          return ConfigNode{[&values, i](ConfigArchive& a) { values[i].visit(a); }};
        },
        doc);
  }
};

/// Reads `path` over the defaults in `root`. Error: `file:line: unknown key 'x'; did you mean
/// 'y'?`, `file:line: 'x' is 7 m; allowed 0 to 4`, or what is wrong with the file. On error `root`
/// may be half-filled.
[[nodiscard]] Result<void> loadYaml(const std::string& path, const ConfigNode& root);
[[nodiscard]] Result<void> loadYamlText(const std::string& text, const std::string& name,
                                        const ConfigNode& root);
/// One value over those in `root`: "base.max_speed_mps=1.5". Error: as loadYaml(), or what is wrong
/// with the text.
[[nodiscard]] Result<void> overrideYaml(const std::string& key_and_value, const ConfigNode& root);
/// The effective configuration as YAML.
[[nodiscard]] std::string dumpYaml(const ConfigNode& root);
/// A Markdown table: key, default, unit, range, meaning.
[[nodiscard]] std::string referenceTable(const ConfigNode& root);

template <class T>
[[nodiscard]] Result<void> loadConfig(const std::string& path, T& config) {
  return loadYaml(path, ConfigNode{[&config](ConfigArchive& a) { config.visit(a); }});
}
template <class T>
[[nodiscard]] Result<void> overrideConfig(const std::string& key_and_value, T& config) {
  return overrideYaml(key_and_value, ConfigNode{[&config](ConfigArchive& a) { config.visit(a); }});
}
template <class T>
[[nodiscard]] std::string dumpConfig(T config) {
  return dumpYaml(ConfigNode{[&config](ConfigArchive& a) { config.visit(a); }});
}

/// The name in `candidates` nearest to `name` by edit distance, or empty if none is near.
[[nodiscard]] std::string nearestName(const std::string& name,
                                      const std::vector<std::string>& candidates);

}  // namespace kiln
