#include "robot/drivers/lepton/codec/lepton_frame.h"

namespace kiln::lepton {

Result<LeptonFrame> splitFrame(int width, int height, std::vector<std::uint16_t> words) {
  if (width <= 0 || height <= 0 ||
      words.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    return makeError(ErrorCode::InvalidInput, "thermal picture of {} x {} has {} values", width,
                     height, words.size());
  }
  LeptonFrame out;
  out.width = width;
  out.height = height;
  out.counts = std::move(words);
  if (width != kWidth || height != kHeight + kTelemetryRows) return out;
  constexpr std::size_t kPixels = static_cast<std::size_t>(kWidth) * kHeight;
  auto telemetry = parseTelemetry(std::span(out.counts).subspan(kPixels));
  if (!telemetry) return tl::make_unexpected(telemetry.error());
  out.telemetry = *telemetry;
  out.height = kHeight;
  out.counts.resize(kPixels);
  return out;
}

std::string whyNoTemperatures(const LeptonFrame& frame) {
  if (!frame.telemetry)
    return "no telemetry, so nothing says that its values are temperatures; record with telemetry "
           "as footer (160 x 122) or as .tjsn";
  if (frame.telemetry->agc)
    return "AGC was on, so its values are contrast, not temperatures; switch AGC off in the camera";
  if (!frame.telemetry->tlinear)
    return "TLinear was off, so its values are no temperatures; switch TLinear on in the camera";
  if (frame.telemetry->ffc == FfcState::Running)
    return "taken while the shutter was closed, so it shows the shutter; take another one";
  return {};
}

ThermalImage toThermalImage(const LeptonFrame& frame) {
  ThermalImage out;
  out.width = frame.width;
  out.height = frame.height;
  out.counts = frame.counts;
  out.tlinear = frame.telemetry && frame.telemetry->tlinear && !frame.telemetry->agc;
  if (frame.telemetry) {
    out.agc = frame.telemetry->agc;
    out.ffc = frame.telemetry->ffc;
    out.frame_counter = frame.telemetry->frame_counter;
    out.kelvin_per_count = frame.telemetry->kelvin_per_count;
  }
  return out;
}

}  // namespace kiln::lepton
