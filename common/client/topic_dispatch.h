#pragma once

#include <string_view>

#include "common/client/operator_session.h"

namespace kiln {

/// Decodes one published payload and hands it to its callback, if there is one. Error: corrupt
/// payload, nothing was called. RobotStatus goes to `on_status` here as well as to the callback:
/// the session reads its lease.
[[nodiscard]] Result<void> dispatch(Topic topic, std::string_view payload,
                                    const OperatorSession::Callbacks& callbacks,
                                    const Arrival& arrival,
                                    const std::function<void(const RobotStatus&)>& on_status);

}  // namespace kiln
