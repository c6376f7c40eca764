#pragma once

#include <memory>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "common/core/clock.h"
#include "common/core/error.h"
#include "robot/sim_link/sim_link.h"

namespace kiln {

/// kiln-sim in lockstep as a child process, with its devices: for routines that move the robot
/// themselves, without kiln-robotd. Confined to one thread.
class LockstepWorld {
 public:
  /// @param purpose  names the scratch folder.
  /// @param world    world file or its name; empty: the default one.
  /// Errors: those of starting a program and of SimLink::connect().
  [[nodiscard]] static Result<std::unique_ptr<LockstepWorld>> start(const std::string& purpose,
                                                                    int seed,
                                                                    const std::string& world,
                                                                    const Clock& clock);
  ~LockstepWorld();
  LockstepWorld(const LockstepWorld&) = delete;
  LockstepWorld& operator=(const LockstepWorld&) = delete;

  /// @pre end() has not been called.
  [[nodiscard]] SimLink& link();
  /// Says bye, ends the world and reads its truth report. Error: NotFound, with the world's last
  /// words, if it left none.
  [[nodiscard]] Result<nlohmann::json> end();

 private:
  struct Impl;
  explicit LockstepWorld(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
