#pragma once

#include <string_view>

namespace kiln::fsm_detail {

/// The class name of T without its namespaces, taken from the compiler ("[with T = kiln::AimHose;
/// ...]" in g++,
/// "[T = kiln::AimHose]" in clang).
template <class T>
[[nodiscard]] constexpr std::string_view typeName() {
  constexpr std::string_view signature = __PRETTY_FUNCTION__;
  constexpr std::string_view key = "T = ";
  const std::size_t begin = signature.find(key) + key.size();
  const std::size_t end = signature.find_first_of(";]", begin);
  const std::string_view full = signature.substr(begin, end - begin);
  const std::size_t colons = full.rfind("::");
  return colons == std::string_view::npos ? full : full.substr(colons + 2);
}

}  // namespace kiln::fsm_detail
