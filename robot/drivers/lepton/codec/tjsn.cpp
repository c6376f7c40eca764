#include "robot/drivers/lepton/codec/tjsn.h"

#include <string>

#include <nlohmann/json.hpp>

#include "robot/drivers/lepton/codec/base64.h"

namespace kiln::lepton {
namespace {

Result<std::vector<std::uint16_t>> words(const nlohmann::json& root, const char* key,
                                         std::size_t expected) {
  const auto it = root.find(key);
  if (it == root.end() || !it->is_string()) {
    return makeError(ErrorCode::InvalidInput, "has no '{}' text; needs base64 words", key);
  }
  const auto bytes = decodeBase64(it->get_ref<const std::string&>());
  if (!bytes) return makeError(ErrorCode::InvalidInput, "'{}' is not valid base64", key);
  if (bytes->size() != 2 * expected) {
    return makeError(ErrorCode::Truncated, "'{}' has {} bytes; needs {}", key, bytes->size(),
                     2 * expected);
  }
  std::vector<std::uint16_t> out(expected);
  for (std::size_t i = 0; i < expected; ++i) {
    out[i] = static_cast<std::uint16_t>((*bytes)[2 * i] | (*bytes)[2 * i + 1] << 8);
  }
  return out;
}

}  // namespace

Result<LeptonFrame> parseTjsn(std::string_view text) {
  const auto root = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!root.is_object()) return makeError(ErrorCode::InvalidInput, "is not valid JSON (cut off?)");
  auto counts = words(root, "radiometric", static_cast<std::size_t>(kWidth) * kHeight);
  if (!counts) return tl::make_unexpected(counts.error());
  LeptonFrame out;
  out.counts = std::move(*counts);
  if (!root.contains("telemetry")) return out;  // tCam leaves it out when telemetry is off
  const auto telemetry_words = words(root, "telemetry", kTelemetryWords);
  if (!telemetry_words) return tl::make_unexpected(telemetry_words.error());
  const auto telemetry = parseTelemetry(*telemetry_words);
  if (!telemetry) return tl::make_unexpected(telemetry.error());
  out.telemetry = *telemetry;
  return out;
}

}  // namespace kiln::lepton
