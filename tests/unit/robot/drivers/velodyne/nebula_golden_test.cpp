// Against another program's decode of the same packets (tier4/nebula). Two quirks of that decode
// keep it from 100 %: it does not interpolate the last pair of a packet, and gives odd blocks
// (return types 5 and 10) the next pair's azimuth.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <tuple>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "robot/drivers/velodyne/codec/vlp16_decoder.h"
#include "robot/drivers/velodyne/link/packet_file.h"
#include "tests/support/data_dir.h"

namespace kiln::velodyne {
namespace {

struct GoldenPoint {  // 32 bytes a point in the PCD, packed
  Eigen::Vector3f p;
  std::uint8_t return_type;
  std::uint16_t ring;
  float distance;
  std::uint32_t time_ns;  // after the packet's first firing
  [[nodiscard]] bool hasQuirk() const {
    constexpr std::uint32_t kLastPair_ns = 5 * 221'184;
    return time_ns >= kLastPair_ns || return_type == 5 || return_type == 10;
  }
};

std::vector<GoldenPoint> readGolden(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  for (std::string line; std::getline(in, line) && line != "DATA binary";) {
  }
  std::vector<GoldenPoint> out;
  std::array<char, 32> raw{};
  while (in.read(raw.data(), raw.size())) {
    GoldenPoint p{};
    std::memcpy(p.p.data(), raw.data(), 12);
    p.return_type = static_cast<std::uint8_t>(raw[13]);
    std::memcpy(&p.ring, raw.data() + 14, 2);
    std::memcpy(&p.distance, raw.data() + 24, 4);
    std::memcpy(&p.time_ns, raw.data() + 28, 4);
    out.push_back(p);
  }
  return out;
}

/// The decoded points of the whole recording in cubes of 2 cm.
class Points {
 public:
  explicit Points(PacketFile& file) {
    Vlp16Decoder decoder({.vertical_correction = false});  // the golden decode knows none
    Decoded decoded;
    for (auto next = file.next(); next && next->has_value(); next = file.next()) {
      const auto packet = parseVlp16Packet((*next)->payload);
      EXPECT_TRUE(packet.has_value()) << packet.error();
      EXPECT_EQ(packet->mode, ReturnMode::Dual);
      ++packets;
      decoder.decode(*packet, decoded);
      for (const DecodedPoint& p : decoded.points) cubes_[cube({p.x, p.y, p.z})].push_back(p);
    }
  }
  int packets = 0;

  /// Distance from p to the nearest point that `accept` takes, at most 2 cm.
  template <class Accept>
  [[nodiscard]] float nearest(const Eigen::Vector3f& p, Accept accept) const {
    float best = kCube;
    const auto [cx, cy, cz] = cube(p);
    for (int i = 0; i < 27; ++i) {
      const auto it = cubes_.find({cx + i % 3 - 1, cy + i / 3 % 3 - 1, cz + i / 9 - 1});
      if (it == cubes_.end()) continue;
      for (const DecodedPoint& q : it->second) {
        if (accept(q)) best = std::min(best, (Eigen::Vector3f(q.x, q.y, q.z) - p).norm());
      }
    }
    return best;
  }

 private:
  static constexpr float kCube = 0.02f;
  using Cube = std::tuple<int, int, int>;
  static Cube cube(const Eigen::Vector3f& p) {
    const auto index = [](float v) { return static_cast<int>(std::floor(v / kCube)); };
    return {index(p.x()), index(p.y()), index(p.z())};
  }
  std::map<Cube, std::vector<DecodedPoint>> cubes_;
};

TEST(NebulaGolden, IsMetWithinFiveMillimetres) {
  const auto bin = kiln::testing::dataFile("nebula_vlp16/packets_1206.bin");
  const auto pcd = kiln::testing::dataFile("nebula_vlp16/1673400472138016708.pcd");
  if (!bin || !pcd) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto golden = readGolden(*pcd);
  ASSERT_EQ(golden.size(), 14831u);
  auto file = openPacketFile(bin->string());
  ASSERT_TRUE(file.has_value()) << file.error();
  const Points ours(**file);
  EXPECT_EQ(ours.packets, 603);

  std::size_t near = 0, sound = 0, sound_near = 0;
  for (const GoldenPoint& g : golden) {
    near += ours.nearest(g.p, [](const DecodedPoint&) { return true; }) <= 0.005f ? 1 : 0;
    if (g.hasQuirk()) continue;
    ++sound;  // of these only the very same echo counts: same laser, same distance
    const auto same_echo = [&g](const DecodedPoint& q) {
      return q.ring == g.ring &&
             std::abs(Eigen::Vector3f(q.x, q.y, q.z).norm() - g.distance) < 5e-4f;
    };
    sound_near += ours.nearest(g.p, same_echo) <= 0.002f ? 1 : 0;
  }
  const double share = static_cast<double>(near) / static_cast<double>(golden.size());
  const double sound_share = static_cast<double>(sound_near) / static_cast<double>(sound);
  std::printf(
      "nearest point within 5 mm: %.2f %% of %zu; same echo within 2 mm: %.2f %% of the %zu "
      "without a quirk\n",
      100 * share, golden.size(), 100 * sound_share, sound);
  EXPECT_GE(share, 0.94);
  EXPECT_GT(sound, 12000u);
  EXPECT_GE(sound_share, 0.998);
}

}  // namespace
}  // namespace kiln::velodyne
