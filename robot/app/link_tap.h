#pragma once

#include <functional>
#include <string>

#include "common/model/link.h"
#include "common/transport/topics.h"

namespace kiln {

/// Somebody who hears everything that goes over the operator link: the recorder. Called on the
/// thread that publishes; must be quick.
struct LinkTap {
  using Encode = std::function<std::string()>;
  std::function<void(Topic topic, const Encode& encode, Stamp now)> published;
  std::function<void(const Command& command, Stamp received)> command;
  std::function<void(const CommandAck& ack, Stamp now)> ack;
};

}  // namespace kiln
