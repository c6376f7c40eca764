#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/model/status.h"

namespace kiln {

/// The robot's alarms: raised by condition, latched until acknowledged, first-out order kept. An
/// alarm asks for a response; what asks for none is a log line. Confined to the mission thread.
class AlarmBook {
 public:
  /// Raises or ends an alarm by its condition. A raised alarm keeps its first time stamp.
  void set(const std::string& id, bool active, AlarmLevel level, const std::string& text,
           const std::string& action, Stamp now);
  /// @return false if there is no such alarm.
  bool acknowledge(const std::string& id);
  /// Active ones and ended ones that nobody has acknowledged yet; oldest first.
  [[nodiscard]] std::vector<Alarm> list() const;

 private:
  std::map<std::string, Alarm> alarms_;
};

}  // namespace kiln
