#pragma once

#include <nlohmann/json.hpp>

#include "robot/missions/common/mission.h"

namespace kiln {

/// A mission that is nothing but its state machine.
class MachineMission : public Mission {
 public:
  explicit MachineMission(Machine& machine) : machine_(machine) {}
  [[nodiscard]] Machine& machine() override { return machine_; }
  void beginAnew(Stamp) override {}
  void observe(Stamp) override {}
  void onReset(Stamp) override {}
  [[nodiscard]] nlohmann::json save() const override { return nlohmann::json::object(); }
  [[nodiscard]] Result<void> restore(const nlohmann::json&) override { return {}; }
  [[nodiscard]] double limitS() const override { return 0.0; }

 private:
  Machine& machine_;
};

}  // namespace kiln
