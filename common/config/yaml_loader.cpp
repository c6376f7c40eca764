#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include "common/config/config_archive.h"
#include "common/core/regular_file.h"

namespace kiln {
namespace {

/// Walks a YAML mapping beside the visited fields; keeps the first error only.
class YamlLoader final : public ConfigArchive {
 public:
  YamlLoader(const YAML::Node& map, const std::string& file, std::string& error)
      : map_(map), file_(file), error_(error) {}

  void field(const char* name, double& value, const char* unit, double min, double max,
             const char*) override {
    if (const auto node = find(name)) readNumber(name, *node, value, unit, min, max);
  }
  void field(const char* name, int& value, const char* unit, int min, int max,
             const char*) override {
    const auto node = find(name);
    if (!node) return;
    int parsed = 0;
    if (!YAML::convert<int>::decode(*node, parsed))
      return fail(*node, fmt::format("'{}' must be a whole number", name));
    if (parsed < min || parsed > max) {
      return fail(*node,
                  fmt::format("'{}' is {} {}; allowed {} to {}", name, parsed, unit, min, max));
    }
    value = parsed;
  }
  void field(const char* name, bool& value, const char*) override {
    const auto node = find(name);
    if (node && !YAML::convert<bool>::decode(*node, value)) {
      fail(*node, fmt::format("'{}' must be true or false", name));
    }
  }
  void field(const char* name, std::string& value, const char*) override {
    const auto node = find(name);
    if (!node) return;
    if (!node->IsScalar()) return fail(*node, fmt::format("'{}' must be a text", name));
    value = node->Scalar();
  }
  void choice(const char* name, std::string& value, const std::vector<std::string>& allowed,
              const char* doc) override {
    field(name, value, doc);
    const YAML::Node node = map_[name];
    if (!node.IsDefined() || !error_.empty()) return;
    if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
    const std::string near = nearestName(value, allowed);
    fail(node, fmt::format("'{}' is '{}'; allowed: {}{}", name, value, fmt::join(allowed, ", "),
                           near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  }
  void field(const char* name, std::vector<double>& value, const char* unit, double min, double max,
             const char*, bool fixed) override {
    const auto node = find(name);
    if (!node) return;
    if (!node->IsSequence())
      return fail(*node, fmt::format("'{}' must be a list of numbers", name));
    if (fixed && !value.empty() && node->size() != value.size()) {
      return fail(
          *node, fmt::format("'{}' has {} entries; it needs {}", name, node->size(), value.size()));
    }
    value.assign(node->size(), 0.0);
    for (std::size_t i = 0; i < node->size(); ++i)
      readNumber(name, (*node)[i], value[i], unit, min, max);
  }
  void sectionNode(const char* name, const ConfigNode& child, const char*) override {
    if (const auto node = find(name)) visitMap(name, *node, child);
  }
  void listNode(const char* name, std::size_t, const std::function<void(std::size_t)>& resize,
                const std::function<ConfigNode(std::size_t)>& item, const char*) override {
    const auto node = find(name);
    if (!node) return;
    if (!node->IsSequence()) return fail(*node, fmt::format("'{}' must be a list", name));
    resize(node->size());
    for (std::size_t i = 0; i < node->size(); ++i) visitMap(name, (*node)[i], item(i));
  }

  /// After the visit: every key of the file must have been asked for, once.
  void refuseUnknownKeys() {
    std::set<std::string> seen;
    for (const auto& entry : map_) {
      const std::string key = entry.first.Scalar();
      if (!seen.insert(key).second)
        return fail(entry.first, fmt::format("key '{}' stands twice; leave one of them", key));
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      const std::string near = nearestName(key, known_);
      return fail(entry.first,
                  fmt::format("unknown key '{}'{}", key,
                              near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
  }

 private:
  std::optional<YAML::Node> find(const char* name) {
    known_.emplace_back(name);
    const YAML::Node node = map_[name];
    if (!node.IsDefined() || !error_.empty()) return std::nullopt;
    return node;
  }
  void readNumber(const char* name, const YAML::Node& node, double& value, const char* unit,
                  double min, double max) {
    double parsed = 0.0;
    if (!YAML::convert<double>::decode(node, parsed))
      return fail(node, fmt::format("'{}' must be a number", name));
    if (!(parsed >= min && parsed <= max)) {
      return fail(node,
                  fmt::format("'{}' is {} {}; allowed {} to {}", name, parsed, unit, min, max));
    }
    value = parsed;
  }
  void visitMap(const char* name, const YAML::Node& node, const ConfigNode& child) {
    if (!node.IsMap())
      return fail(node, fmt::format("'{}' must be a mapping of keys to values", name));
    YamlLoader loader(node, file_, error_);
    child.visit(loader);
    loader.refuseUnknownKeys();
  }
  void fail(const YAML::Node& node, const std::string& what) {
    if (error_.empty()) error_ = fmt::format("{}:{}: {}", file_, node.Mark().line + 1, what);
  }

  YAML::Node map_;
  const std::string& file_;
  std::string& error_;
  std::vector<std::string> known_;
};

}  // namespace

Result<void> loadYamlText(const std::string& text, const std::string& name,
                          const ConfigNode& root) {
  try {
    const YAML::Node document = YAML::Load(text);
    if (document.IsNull()) {
      return makeError(ErrorCode::InvalidInput, "{}:1: says nothing; give a file with its keys",
                       name);
    }
    if (!document.IsMap())
      return makeError(ErrorCode::InvalidInput, "{}:1: expected 'key: value' lines", name);
    std::string error;
    YamlLoader loader(document, name, error);
    root.visit(loader);
    loader.refuseUnknownKeys();
    if (!error.empty()) return makeError(ErrorCode::InvalidInput, "{}", error);
    return {};
  } catch (const YAML::Exception& e) {
    return makeError(ErrorCode::InvalidInput, "{}:{}: {}", name, e.mark.line + 1, e.msg);
  }
}

Result<void> overrideYaml(const std::string& key_and_value, const ConfigNode& root) {
  const std::size_t equals = key_and_value.find('=');
  if (equals == std::string::npos || equals == 0)
    return makeError(ErrorCode::InvalidInput,
                     "'{}' sets nothing; write KEY=VALUE, as in base.max_speed_mps=1.5",
                     key_and_value);
  std::string yaml = "{";
  int depth = 1;
  for (const char c : key_and_value.substr(0, equals)) {
    yaml += c == '.' ? std::string(": {") : std::string(1, c);
    depth += c == '.' ? 1 : 0;
  }
  yaml += ": " + key_and_value.substr(equals + 1);
  yaml.append(static_cast<std::size_t>(depth), '}');
  return loadYamlText(yaml, key_and_value, root);
}

Result<void> loadYaml(const std::string& path, const ConfigNode& root) {
  constexpr std::uint64_t kMostBytes = 1U << 20;
  const auto text = readRegularFile(path, kMostBytes);
  if (!text) return tl::make_unexpected(text.error());
  return loadYamlText(*text, path, root);
}

}  // namespace kiln
