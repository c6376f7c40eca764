#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/mission_run.h"
#include "robot/evaluation/scripted_operator.h"
#include "robot/evaluation/skewed_clock.h"

namespace kiln {

/// World and daemon in real time, as processes of their own, with the operator link on private
/// sockets. The operator's computer has a clock of its own: off by up to 3 s by seed, and 20 ppm.
class LiveSystem {
 public:
  /// @param programs  folder of kiln-sim and kiln-robotd; empty = beside this program.
  [[nodiscard]] static Result<std::unique_ptr<LiveSystem>> start(
      int seed, const std::vector<std::string>& robot_args,
      const std::vector<std::string>& world_args, const std::string& programs = {});
  [[nodiscard]] std::string linkEndpoint() const { return "ipc://" + scratch_.file("link"); }
  [[nodiscard]] Result<std::unique_ptr<ScriptedOperator>> connectOperator(
      const std::string& name) const;
  [[nodiscard]] ChildProcess& robot() { return *robot_; }
  [[nodiscard]] ChildProcess& world() { return *world_; }
  [[nodiscard]] const ScratchFolder& scratch() const { return scratch_; }
  /// Ends the daemon and the world in order; the world's truth report as JSON text.
  [[nodiscard]] Result<std::string> finish();

 private:
  explicit LiveSystem(int seed);
  ScratchFolder scratch_;
  SkewedClock operator_clock_;
  std::unique_ptr<ChildProcess> world_, robot_;
};

}  // namespace kiln
