#include "robot/drivers/velodyne/device/capture_check.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/ranges.h>

namespace kiln::velodyne {
namespace {

constexpr Duration kPause = std::chrono::seconds(1);

/// First reading: who sends what.
class Census {
 public:
  explicit Census(CaptureSummary& summary) : summary_(summary) {}
  void add(const RecordedPacket& packet) {
    if (packet.port == kPositionPort) {
      ++summary_.position_packets;
      if (auto position = parsePositionPacket(packet.payload)) summary_.position = *position;
    } else if (packet.missing > 0) {
      packet.port == kDataPort ? addCut(packet) : void(++summary_.other_packets);
    } else if (const auto parsed = parseVlp16Packet(packet.payload)) {
      Sensor& sensor = sensors_[{packet.source, packet.port}];
      if (sensor.packets++ == 0) sensor.mode = parsed->mode;
    } else if (packet.port == kDataPort) {
      addRefused(parsed.error());
    } else {
      ++summary_.other_packets;
    }
  }
  void finish() {
    std::uint64_t all = 0;
    for (const auto& [key, sensor] : sensors_) {
      all += sensor.packets;
      if (sensor.packets <= summary_.data_packets) continue;
      summary_.sensor = key;
      summary_.data_packets = sensor.packets;
      summary_.mode = sensor.mode;
    }
    summary_.other_sensors = all - summary_.data_packets;
  }

 private:
  struct Sensor {
    std::uint64_t packets = 0;
    ReturnMode mode = ReturnMode::Strongest;
  };
  void addCut(const RecordedPacket& packet) {
    if (summary_.refused.cut++ > 0) return;
    summary_.refused.first_cut = fmt::format(
        "a LiDAR packet was captured with {} of its {} bytes; record with a snap length of at "
        "least 1248 (tcpdump -s 0)",
        packet.payload.size(), packet.payload.size() + packet.missing);
  }
  void addRefused(const Error& why) {
    Refusals& r = summary_.refused;
    const auto count = [&](std::uint64_t& number, std::string& first) {
      if (number++ == 0) first = why.message;
    };
    if (why.code == ErrorCode::Truncated) return count(r.other_size, r.first_size);
    if (why.code == ErrorCode::VersionMismatch) return count(r.other_model, r.first_model);
    count(r.damaged, r.first_damage);
  }
  CaptureSummary& summary_;
  std::map<SensorKey, Sensor> sensors_;
};

Result<void> takeCensus(PacketFile& file, CaptureSummary& summary) {
  Census census(summary);
  std::optional<Duration> last;
  for (;;) {
    const auto packet = file.next();
    if (!packet) return tl::make_unexpected(packet.error());
    if (!*packet) break;
    census.add(**packet);
    const Duration pause = last ? (*packet)->time - *last : Duration{};
    if (pause > kPause) summary.longest_pause = std::max(summary.longest_pause, pause);
    last = (*packet)->time;
  }
  census.finish();
  summary.link = file.counts();
  return {};
}

/// Why there is nothing to play.
Error noData(const std::string& path, const CaptureSummary& s) {
  const auto error = [&](std::string why) {
    return Error{ErrorCode::Degenerate, fmt::format("{}: {}", path, why)};
  };
  if (s.refused.total() > 0) {
    return error(fmt::format("none of its {} packets on UDP port {} can be played: {}",
                             s.refused.total(), kDataPort, s.refused.mostFrequent()));
  }
  if (s.link.incomplete > 0) {
    return error(
        fmt::format("its packets are fragmented, and pieces of all {} are missing; record "
                    "without a port filter",
                    s.link.incomplete));
  }
  if (s.position_packets > 0) {
    return error(
        fmt::format("{} position packets and no data packet (UDP port {}): the sensor "
                    "lives but sends no data; is its laser on?",
                    s.position_packets, kDataPort));
  }
  if (s.link.other_links > 0) {
    return error(
        fmt::format("its frames have link type {}; needed is Ethernet, Linux cooked or "
                    "raw IP",
                    s.link.other_link));
  }
  return error(
      fmt::format("holds no LiDAR data packet (UDP port {}); record the sensor's traffic, "
                  "e.g. tcpdump udp port {}",
                  kDataPort, kDataPort));
}

/// Second reading: the chosen sensor as it will be played.
Result<void> playOnce(PacketFile& file, const ScanAssembler::Config& config,
                      CaptureSummary& summary) {
  if (auto ok = file.rewind(); !ok) return ok;
  CaptureStream stream(file, summary.sensor);
  ScanAssembler assembler(config);
  for (;;) {
    const auto packet = stream.next();
    if (!packet) return tl::make_unexpected(packet.error());
    if (!*packet) break;
    (void)assembler.feed((*packet)->payload, Stamp{(*packet)->time});
    summary.length = (*packet)->time;
  }
  summary.scan = assembler.statistics();
  summary.sequence = stream.counts();
  return file.rewind();
}

}  // namespace

const std::string& Refusals::mostFrequent() const {
  const std::array<std::pair<std::uint64_t, const std::string*>, 4> kinds{
      {{other_model, &first_model},
       {cut, &first_cut},
       {other_size, &first_size},
       {damaged, &first_damage}}};
  return *std::max_element(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) {
            return a.first < b.first;
          })->second;
}

std::string defectsOf(const CaptureSummary& s) {
  std::vector<std::string> out;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) out.push_back(fmt::format("{} {}", count, what));
  };
  add(s.scan.lost, s.scan.lost == 1 ? "packet lost" : "packets lost");
  if (s.refused.total() > 0)
    out.push_back(fmt::format("{} refused ({})", s.refused.total(), s.refused.mostFrequent()));
  add(s.link.incomplete, "with missing fragments");
  add(s.sequence.doubles, "double");
  add(s.sequence.late, "late");
  if (s.sequence.jumps > 0)
    out.push_back(fmt::format("the sensor's clock jumped {} x", s.sequence.jumps));
  if (s.longest_pause > Duration{})
    out.push_back(fmt::format("a pause of {:.0f} s shortened", toSeconds(s.longest_pause)));
  if (s.other_sensors > 0) {
    out.push_back(fmt::format("{} packets of another sensor left out (shown is {})",
                              s.other_sensors, toString(s.sensor)));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

Result<CaptureSummary> checkCapture(PacketFile& file, const ScanAssembler::Config& config) {
  CaptureSummary summary;
  if (auto counted = takeCensus(file, summary); !counted)
    return tl::make_unexpected(counted.error());
  if (summary.data_packets == 0) return tl::make_unexpected(noData(file.path(), summary));
  if (auto played = playOnce(file, config, summary); !played)
    return tl::make_unexpected(played.error());
  if (summary.scan.revolutions == 0) {
    return makeError(ErrorCode::Degenerate,
                     "{}: {} data packets are less than one full revolution; record at least 0.3 s",
                     file.path(), summary.data_packets);
  }
  return summary;
}

}  // namespace kiln::velodyne
