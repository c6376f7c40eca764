#include "robot/fsm/uuid.h"

#include <random>

#include <fmt/format.h>

namespace kiln {

std::string randomUuid() {
  std::random_device device;
  const auto word = [&device] { return static_cast<unsigned>(device()); };
  const unsigned c = word();
  return fmt::format("{:08x}-{:04x}-4{:03x}-{:04x}-{:04x}{:08x}", word(), word() & 0xffffU,
                     word() & 0xfffU, 0x8000U | (c & 0x3fffU), c >> 16U, word());
}

}  // namespace kiln
