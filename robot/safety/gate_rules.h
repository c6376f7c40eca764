#pragma once

#include "robot/safety/command_gate.h"

/// The mode table and the preconditions that need no numbers; pure functions of the situation.
namespace kiln::gate {

[[nodiscard]] GateDecision refuse(std::string code, std::string reason);
/// A clear that names another STOP than the newest.
[[nodiscard]] GateDecision refuseNewerStop();
/// Does this command need the lease at all?
[[nodiscard]] bool needsLease(const CommandBody& body);
/// architecture.md section 6, row by row, then what each command presupposes.
[[nodiscard]] GateDecision checkSituation(const CommandBody& body, const GateSituation& situation);

}  // namespace kiln::gate
