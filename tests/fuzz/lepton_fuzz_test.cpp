#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "robot/drivers/lepton/codec/base64.h"
#include "robot/drivers/lepton/codec/tjsn.h"
#include "robot/drivers/lepton/link/still_file.h"
#include "robot/perception/thermal/heat_detector.h"
#include "tests/fuzz/mutator.h"
#include "tests/support/data_dir.h"

namespace kiln::lepton {
namespace {

using fuzz::Bytes;
using fuzz::Mutator;

Result<LeptonFrame> parse(const Bytes& bytes) {
  return parseTjsn({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void expectSane(const LeptonFrame& frame) {
  ASSERT_EQ(frame.counts.size(),
            static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
}

Bytes goodTjsn() {
  Bytes pixels(2 * 160 * 120), telemetry(2 * kTelemetryWords, 0);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<std::uint8_t>(i % 2 == 0 ? i / 160 : 0x74);
  telemetry[0] = 14;
  telemetry[2 * 208] = telemetry[2 * 209] = 1;
  const std::string text = R"({"metadata":{},"radiometric":")" + encodeBase64(pixels) +
                           R"(","telemetry":")" + encodeBase64(telemetry) + "\"}";
  return {text.begin(), text.end()};
}

TEST(FuzzLepton, MutatedTjsnNeverCrashesReaderOrDetector) {
  Mutator mutator(1);
  const Bytes good = goodTjsn();
  ASSERT_TRUE(parse(good).has_value());
  HeatDetector detector({});
  int accepted = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto frame = parse(mutator.mutate(good));
    if (!frame) {
      ASSERT_FALSE(frame.error().message.empty());
      continue;
    }
    ++accepted;
    expectSane(*frame);
    ThermalImage image = toThermalImage(*frame);
    image.frame_counter = static_cast<std::uint32_t>(i);
    (void)detector.detect(image);
  }
  EXPECT_GT(accepted, 100);
}

TEST(FuzzLepton, RandomPicturesNeverCrashTheDetector) {
  Mutator mutator(2);
  HeatDetector detector({});
  for (int i = 0; i < 300; ++i) {
    ThermalImage image;
    image.frame_counter = static_cast<std::uint32_t>(i);
    image.width = 8 + static_cast<int>(mutator.below(40));
    image.height = 8 + static_cast<int>(mutator.below(40));
    const std::size_t n = static_cast<std::size_t>(image.width * image.height);
    const Bytes noise = mutator.random(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      const auto word = static_cast<std::uint16_t>(noise[2 * k] | noise[2 * k + 1] << 8);
      image.counts.push_back(i % 2 == 0 ? word : static_cast<std::uint16_t>(29000 + word % 9000));
    }
    const HeatDetections found = detector.detect(image);
    for (const HeatBlob& blob : found.blobs) {
      ASSERT_TRUE(std::isfinite(blob.u) && std::isfinite(blob.v) &&
                  std::isfinite(blob.half_max_area_px));
      ASSERT_GE(blob.u_min, 0);
      ASSERT_LT(blob.u_max, image.width);
    }
  }
}

TEST(FuzzLepton, SplitFrameAndBase64) {
  Mutator mutator(3);
  for (int i = 0; i < 20000; ++i) {
    const Bytes bytes = mutator.random(mutator.below(64));
    const std::string text(bytes.begin(), bytes.end());
    if (const auto decoded = decodeBase64(text)) {
      ASSERT_LE(decoded->size(), text.size());
    }
    ASSERT_EQ(decodeBase64(encodeBase64(bytes)), bytes);
  }
  for (int i = 0; i < 300; ++i) {
    std::vector<std::uint16_t> words(160 * 122);
    for (auto& w : words) w = static_cast<std::uint16_t>(mutator.below(i % 2 == 0 ? 65536 : 3));
    if (const auto frame = splitFrame(160, 122, std::move(words))) expectSane(*frame);
  }
}

TEST(FuzzLepton, MutatedPictureFiles) {
  const auto png = kiln::testing::dataFile("lepton_tcam/agc_off.png");
  const auto tiff = kiln::testing::dataFile("flirpy_thermal/example_radiometric.tiff");
  if (!png || !tiff) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  Mutator mutator(4);
  for (const auto& source : {*png, *tiff}) {
    std::ifstream in(source, std::ios::binary);
    const Bytes good{std::istreambuf_iterator<char>(in), {}};
    const auto path = std::filesystem::temp_directory_path() /
                      ("kiln_fuzz_" + std::to_string(::getpid()) + source.extension().string());
    for (int i = 0; i < 200; ++i) {
      const Bytes bad = mutator.mutate(good);
      std::ofstream(path, std::ios::binary)
          .write(reinterpret_cast<const char*>(bad.data()),
                 static_cast<std::streamsize>(bad.size()));
      if (const auto frame = readStill(path.string())) expectSane(*frame);
    }
    std::filesystem::remove(path);
  }
}

}  // namespace
}  // namespace kiln::lepton
