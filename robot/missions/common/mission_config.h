#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/config/config_archive.h"

namespace kiln {

/// The section of the robot's configuration that belongs to one mission, without its type.
class MissionConfig {
 public:
  virtual ~MissionConfig() = default;
  virtual void visit(ConfigArchive& a) = 0;
  [[nodiscard]] virtual std::unique_ptr<MissionConfig> clone() const = 0;
};

/// One mission's own struct as such a section.
template <class T>
struct MissionConfigOf final : MissionConfig {
  T value;
  void visit(ConfigArchive& a) override { value.visit(a); }
  [[nodiscard]] std::unique_ptr<MissionConfig> clone() const override {
    return std::make_unique<MissionConfigOf>(*this);
  }
};

/// The sections of all missions, a value like any other config.
class MissionConfigs {
 public:
  struct Section {
    std::string name;
    std::string doc;
    std::unique_ptr<MissionConfig> config;
  };
  MissionConfigs() = default;
  explicit MissionConfigs(std::vector<Section> sections) : sections_(std::move(sections)) {}
  MissionConfigs(const MissionConfigs& other) {
    for (const Section& section : other.sections_)
      sections_.push_back({section.name, section.doc, section.config->clone()});
  }
  MissionConfigs& operator=(MissionConfigs other) {
    sections_.swap(other.sections_);
    return *this;
  }
  MissionConfigs(MissionConfigs&&) noexcept = default;
  ~MissionConfigs() = default;

  void visit(ConfigArchive& a) {
    for (Section& section : sections_)
      a.section(section.name.c_str(), *section.config, section.doc.c_str());
  }
  /// nullptr: no mission of that name.
  [[nodiscard]] const MissionConfig* find(const std::string& name) const {
    for (const Section& section : sections_)
      if (section.name == name) return section.config.get();
    return nullptr;
  }

 private:
  std::vector<Section> sections_;
};

}  // namespace kiln
