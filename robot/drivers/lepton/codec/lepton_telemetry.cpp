#include "robot/drivers/lepton/codec/lepton_telemetry.h"

namespace kiln::lepton {
namespace {

constexpr std::size_t kRevision = 0, kUptime = 1, kStatus = 3, kFrameCounter = 20, kFrameMean = 22,
                      kFpa = 24, kHousing = 26, kTLinear = 208, kResolution = 209;
constexpr double kCentikelvin = 0.01;

std::uint32_t lowWordFirst(std::span<const std::uint16_t> words, std::size_t at) {
  return static_cast<std::uint32_t>(words[at + 1]) << 16 | words[at];
}

}  // namespace

Result<LeptonTelemetry> parseTelemetry(std::span<const std::uint16_t> words) {
  if (words.size() < kTelemetryWords) {
    return makeError(ErrorCode::Truncated, "telemetry has {} words; a Lepton sends {}",
                     words.size(), kTelemetryWords);
  }
  if (words[kRevision] == 0) {
    return makeError(ErrorCode::VersionMismatch,
                     "telemetry revision is 0: these words are no Lepton telemetry");
  }
  if (words[kTLinear] > 1 || words[kResolution] > 1) {
    return makeError(ErrorCode::InvalidInput,
                     "telemetry words 208 and 209 (TLinear) are {} and {}; each is 0 or 1",
                     words[kTLinear], words[kResolution]);
  }
  LeptonTelemetry out;
  const std::uint32_t status = lowWordFirst(words, kStatus);
  out.revision = words[kRevision];
  out.uptime_ms = lowWordFirst(words, kUptime);
  out.ffc_desired = (status >> 3 & 1) != 0;
  out.ffc = static_cast<FfcState>(status >> 4 & 3);
  out.agc = (status >> 12 & 1) != 0;
  out.over_temperature = (status >> 20 & 1) != 0;
  out.frame_counter = lowWordFirst(words, kFrameCounter);
  out.frame_mean = words[kFrameMean];
  out.fpa_k = words[kFpa] * kCentikelvin;
  out.housing_k = words[kHousing] * kCentikelvin;
  out.tlinear = words[kTLinear] == 1;
  out.kelvin_per_count = words[kResolution] == 1 ? 0.01 : 0.1;
  return out;
}

}  // namespace kiln::lepton
