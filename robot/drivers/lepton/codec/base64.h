#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kiln::lepton {

/// RFC 4648 with padding. @return nullopt for a character outside the alphabet, wrong padding or a
/// length that is no multiple of four.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> decodeBase64(std::string_view text);
[[nodiscard]] std::string encodeBase64(const std::vector<std::uint8_t>& bytes);

}  // namespace kiln::lepton
