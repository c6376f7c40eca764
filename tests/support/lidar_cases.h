#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/capture_builder.h"
#include "tests/support/synthetic_packets.h"

namespace kiln::testing {

/// A capture that went or could go wrong, and what must come of it.
struct LidarCase {
  std::string name;
  Bytes bytes;
  std::string refusal;  ///< part of the sentence; empty: it plays
  std::string defects;  ///< part of what is said about it; empty: nothing is wrong
};

namespace lidar_cases {

inline constexpr std::int64_t kPeriod_us = 1327;
inline constexpr std::int64_t kBegin_us = 1'700'000'000'000'000;
inline constexpr int kPackets = 60;  ///< a revolution and a half at 1200 rpm

struct Timed {
  std::int64_t time_us = 0;
  Bytes payload;
};

inline std::vector<Timed> packets(std::int64_t begin_us = kBegin_us,
                                  std::uint32_t sensor_us = 1000) {
  velodyne::testing::SyntheticSensor sensor;
  sensor.rpm = 1200;
  sensor.azimuth = 17000;
  sensor.time_us = sensor_us;
  std::vector<Timed> out;
  for (int i = 0; i < kPackets; ++i) {
    const auto bytes = velodyne::encodeVlp16Packet(sensor.next());
    out.push_back({begin_us + i * kPeriod_us, {bytes.begin(), bytes.end()}});
  }
  return out;
}
inline Bytes captureOf(const std::vector<Timed>& packets,
                       CaptureBuilder builder = CaptureBuilder()) {
  for (const Timed& p : packets) builder.datagram(p.time_us, p.payload);
  return builder.bytes();
}
/// The good capture with `stray` behind its 20th packet.
inline Bytes withStray(const Bytes& stray) {
  auto all = packets();
  all.insert(all.begin() + 20, Timed{all[20].time_us, stray});
  return captureOf(all);
}

inline Bytes joined(std::int64_t second_begin_us) {
  auto all = packets();
  const auto more = packets(second_begin_us);
  all.insert(all.end(), more.begin(), more.begin() + 40);
  return captureOf(all);
}
inline Bytes rawWithStray(const Bytes& stray) {
  Bytes out;
  int i = 0;
  for (const Timed& p : packets()) {
    if (i++ == 20) append(out, stray);
    append(out, p.payload);
  }
  return out;
}

inline Bytes losses() {
  auto all = packets();
  for (int i = kPackets - 4; i > 0; i -= 7) all.erase(all.begin() + i);
  return captureOf(all);
}
inline Bytes doubles() {
  auto all = packets();
  for (int i = kPackets - 4; i > 0; i -= 8)
    all.insert(all.begin() + i, all[static_cast<std::size_t>(i)]);
  return captureOf(all);
}
inline Bytes swapped() {
  auto all = packets();
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) std::swap(all[i].payload, all[i + 1].payload);
  return captureOf(all);
}
inline Bytes twoSensors() {
  CaptureBuilder out;
  const auto first = packets(), second = packets(kBegin_us, 900'000'000);
  for (std::size_t i = 0; i < first.size(); ++i) {
    out.datagram(first[i].time_us, first[i].payload);
    if (i % 2 == 0) out.datagram(second[i].time_us, second[i].payload, {202, 2368});
  }
  return out.bytes();
}
inline Bytes fragmented(bool whole) {
  CaptureBuilder out;
  for (const Timed& p : packets()) out.fragments(p.time_us, p.payload, whole);
  return out.bytes();
}
inline Bytes otherTrafficCut() {
  CaptureBuilder out;
  for (const Timed& p : packets()) out.datagram(p.time_us, p.payload, {}, 1248);
  out.datagram(kBegin_us + 100'000, Bytes(1472, 7), {17, 443}, 1248);
  return out.bytes();
}
inline Bytes allCut() {
  CaptureBuilder out;
  for (const Timed& p : packets()) out.datagram(p.time_us, p.payload, {}, 96);
  return out.bytes();
}
inline Bytes onlyPosition() {
  CaptureBuilder out;
  for (int i = 0; i < 40; ++i)
    out.datagram(kBegin_us + i * 6800, Bytes(512, 0), {201, velodyne::kPositionPort});
  return out.bytes();
}
inline Bytes withTimes(std::int64_t (*time)(int)) {
  auto all = packets();
  for (int i = 0; i < kPackets; ++i) all[static_cast<std::size_t>(i)].time_us = time(i);
  return captureOf(all);
}

}  // namespace lidar_cases

/// Issue 10 section 3, the LiDAR's part.
inline std::vector<LidarCase> lidarCases() {
  using namespace lidar_cases;
  using velodyne::LinkType;
  Bytes zeroed = packets()[20].payload;
  zeroed[300] = zeroed[301] = 0;
  Bytes of_the_future = packets(kBegin_us, 3'000'000'000)[0].payload;
  Bytes garbage(1206, 0);
  for (std::size_t i = 0; i < garbage.size(); ++i) garbage[i] = static_cast<std::uint8_t>(37 * i);
  const Bytes good = captureOf(packets());
  Bytes gzip{0x1F, 0x8B, 8, 0};
  gzip.resize(200, 1);
  return {
      {"good", good, "", ""},
      {"raw", rawWithStray({}), "", ""},
      {"stray_512", withStray(Bytes(512, 0)), "", "1 refused (data packet has 512 bytes"},
      {"stray_5", withStray(Bytes(5, 0)), "", "1 refused (data packet has 5 bytes"},
      {"garbage_1206", withStray(garbage), "", "1 refused"},
      {"zeroed_flag", withStray(zeroed), "", "1 refused (block 3 starts with 00 00"},
      {"one_of_another_time", withStray(of_the_future), "", "1 late"},
      {"raw_stray_5", rawWithStray(Bytes(5, 9)), "", "1 refused (data packet has 5 bytes"},
      {"raw_garbage", rawWithStray(garbage), "", "1 refused"},
      {"losses", losses(), "", "8 packets lost"},
      {"doubles", doubles(), "", "7 double"},
      {"swapped", swapped(), "", "30 late"},
      {"two_sensors", twoSensors(), "",
       "30 packets of another sensor left out (shown is 192.168.1.201"},
      {"fragments", fragmented(true), "", ""},
      {"half_fragments", fragmented(false), "its packets are fragmented", ""},
      {"cooked", captureOf(packets(), CaptureBuilder(LinkType::LinuxCooked)), "", ""},
      {"cooked_v2", captureOf(packets(), CaptureBuilder(LinkType::LinuxCooked2)), "", ""},
      {"raw_ip", captureOf(packets(), CaptureBuilder(LinkType::RawIp)), "", ""},
      {"two_link_types",
       captureOf(packets(), CaptureBuilder({LinkType::LinuxCooked, LinkType::Ethernet})), "", ""},
      {"link_type_147", captureOf(packets(), CaptureBuilder(static_cast<LinkType>(147))),
       "its frames have link type 147", ""},
      {"other_traffic_cut", otherTrafficCut(), "", ""},
      {"all_cut", allCut(), "was captured with", ""},
      {"only_position", onlyPosition(), "40 position packets", ""},
      {"gzip", gzip, "unzip it first", ""},
      {"equal_times", withTimes([](int) { return kBegin_us; }), "", ""},
      {"times_run_back", withTimes([](int i) { return kBegin_us - i * 3'600'000'000; }), "", ""},
      {"parts_in_wrong_order", joined(kBegin_us - 3'600'000'000), "",
       "the sensor's clock jumped 1 x"},
      {"pause_one_hour", joined(kBegin_us + 3'600'000'000), "", "a pause of 3600 s shortened"},
  };
}

}  // namespace kiln::testing
