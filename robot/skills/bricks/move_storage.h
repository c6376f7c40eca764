#pragma once

#include <vector>

#include "common/config/config_archive.h"
#include "robot/hal/storage.h"
#include "robot/skills/skill.h"

namespace kiln {

/// Lets the storage's compartments travel to where a bin can be reached, and says when they are
/// there. Targets are written at each poll; who polls no more leaves them to the device's fail-safe.
/// Failure codes: no_state, jammed (names the compartment), refused, timeout. Confined to the
/// mission thread.
class MoveStorage {
 public:
  struct Config {
    double tolerance_m = 0.003;  ///< counts as there
    double timeout_s = 20.0;     ///< for the whole travel; 0.6 m take 10 s
    double max_age_s = 0.5;      ///< of the measured state
    void visit(ConfigArchive& a);
  };
  /// @param names  of the compartments, in the device's order.
  MoveStorage(const Config& config, Storage& storage, std::vector<std::string> names);
  void start(std::vector<double> targets_m, Stamp now);
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel() { status_ = {}; }

 private:
  SkillStatus fail(std::string code, std::string text);

  Config config_;
  Storage& storage_;
  std::vector<std::string> names_;
  std::vector<double> targets_m_;
  Stamp began_;
  SkillStatus status_;
};

}  // namespace kiln
