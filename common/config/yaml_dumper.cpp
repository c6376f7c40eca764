#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include "common/config/config_archive.h"

namespace kiln {
namespace {

class YamlDumper final : public ConfigArchive {
 public:
  explicit YamlDumper(YAML::Emitter& out) : out_(out) {}
  void field(const char* name, double& value, const char*, double, double, const char*) override {
    entry(name, shortest(value));
  }
  void field(const char* name, int& value, const char*, int, int, const char*) override {
    entry(name, value);
  }
  void field(const char* name, bool& value, const char*) override { entry(name, value); }
  void field(const char* name, std::string& value, const char*) override { entry(name, value); }
  void field(const char* name, std::vector<double>& value, const char*, double, double, const char*,
             bool) override {
    out_ << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginSeq;
    for (const double v : value) out_ << shortest(v);
    out_ << YAML::EndSeq;
  }
  void sectionNode(const char* name, const ConfigNode& child, const char*) override {
    out_ << YAML::Key << name << YAML::Value;
    map(child);
  }
  void listNode(const char* name, std::size_t size, const std::function<void(std::size_t)>&,
                const std::function<ConfigNode(std::size_t)>& item, const char*) override {
    out_ << YAML::Key << name << YAML::Value << YAML::BeginSeq;
    for (std::size_t i = 0; i < size; ++i) map(item(i));
    out_ << YAML::EndSeq;
  }
  void map(const ConfigNode& node) {
    out_ << YAML::BeginMap;
    node.visit(*this);
    out_ << YAML::EndMap;
  }

 private:
  /// The shortest text that reads back as the same number: 0.3, not 0.29999999999999999.
  static std::string shortest(double value) { return fmt::format("{}", value); }
  template <class T>
  void entry(const char* name, const T& value) {
    out_ << YAML::Key << name << YAML::Value << value;
  }
  YAML::Emitter& out_;
};

class TableWriter final : public ConfigArchive {
 public:
  explicit TableWriter(std::string prefix, std::string& out)
      : prefix_(std::move(prefix)), out_(out) {}
  void field(const char* name, double& value, const char* unit, double min, double max,
             const char* doc) override {
    row(name, fmt::format("{}", value), unit, fmt::format("{} to {}", min, max), doc);
  }
  void field(const char* name, int& value, const char* unit, int min, int max,
             const char* doc) override {
    row(name, fmt::format("{}", value), unit, fmt::format("{} to {}", min, max), doc);
  }
  void field(const char* name, bool& value, const char* doc) override {
    row(name, value ? "true" : "false", "", "", doc);
  }
  void field(const char* name, std::string& value, const char* doc) override {
    row(name, value, "", "", doc);
  }
  void field(const char* name, std::vector<double>& value, const char* unit, double min, double max,
             const char* doc, bool) override {
    row(name, fmt::format("[{}]", fmt::join(value, ", ")), unit, fmt::format("{} to {}", min, max),
        doc);
  }
  void sectionNode(const char* name, const ConfigNode& child, const char*) override {
    TableWriter nested(prefix_ + name + ".", out_);
    child.visit(nested);
  }
  void listNode(const char* name, std::size_t size, const std::function<void(std::size_t)>&,
                const std::function<ConfigNode(std::size_t)>& item, const char* doc) override {
    row(name, fmt::format("{} items", size), "", "", doc);
    if (size == 0) return;
    TableWriter nested(prefix_ + name + "[].", out_);
    item(0).visit(nested);
  }

 private:
  void row(const char* name, const std::string& value, const char* unit, const std::string& range,
           const char* doc) {
    out_ += fmt::format("| `{}{}` | {} | {} | {} | {} |\n", prefix_, name, value, unit, range, doc);
  }
  std::string prefix_;
  std::string& out_;
};

}  // namespace

std::string dumpYaml(const ConfigNode& root) {
  YAML::Emitter out;
  YamlDumper(out).map(root);
  return std::string(out.c_str()) + "\n";
}

std::string referenceTable(const ConfigNode& root) {
  std::string out = "| key | default | unit | range | meaning |\n|---|---|---|---|---|\n";
  TableWriter writer("", out);
  root.visit(writer);
  return out;
}

}  // namespace kiln
