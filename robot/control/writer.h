#pragma once

#include <cstdint>

namespace kiln {

/// Whose setpoints an actuator follows. A program is mission or macro, whichever steps: never both.
enum class Writer : std::uint8_t { Program, Hand };

}  // namespace kiln
