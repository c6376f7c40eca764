#pragma once

#include <memory>
#include <optional>
#include <span>

#include "common/model/sensor.h"
#include "robot/drivers/velodyne/codec/vlp16_decoder.h"

namespace kiln::velodyne {

/// What became of the packets so far.
struct ScanStatistics {
  std::uint64_t packets = 0;
  std::uint64_t refused = 0;      ///< malformed or from another model
  std::uint64_t lost = 0;         ///< missing between two packets, by their time stamps
  std::uint64_t restarts = 0;     ///< time ran backwards or jumped by more than a second
  std::uint64_t revolutions = 0;  ///< delivered
  double rpm = 0.0;               ///< of the latest whole revolution; 0 before
};

/// Collects packets into full revolutions in the `lidar` frame. The cut lies behind the robot
/// (azimuth 180 deg), so that nothing ahead of it is torn in time. The first, incomplete revolution
/// is not delivered; lost packets leave a hole and are counted. Thread-compatible.
class ScanAssembler {
 public:
  struct Config {
    Vlp16Decoder::Config decoder;
    int cut_azimuth = 18000;  ///< 0.01 deg
  };
  explicit ScanAssembler(Config config);

  /// @param payload      UDP payload of one data packet.
  /// @param received_at  when it came; sensor time is mapped to robot time by the quickest
  /// arrivals.
  /// @return a revolution if this packet completed one, nullptr otherwise; the parser's Error for a
  /// bad packet (counted).
  [[nodiscard]] Result<PointCloudPtr> feed(std::span<const std::uint8_t> payload,
                                           Stamp received_at);
  /// Forgets the revolution under way and the time mapping (new file, sensor restarted).
  void restart();
  [[nodiscard]] const ScanStatistics& statistics() const { return statistics_; }

 private:
  void countLoss(const Vlp16Packet& packet);
  [[nodiscard]] Stamp packetStamp(const Vlp16Packet& packet, Stamp received_at);
  [[nodiscard]] PointCloudPtr finishRevolution(Stamp at);

  Config config_;
  Vlp16Decoder decoder_;
  Decoded decoded_;
  ScanStatistics statistics_;
  std::shared_ptr<PointCloud> scan_;  ///< nullptr until the first cut was seen
  Stamp scan_start_{};
  std::optional<std::uint32_t> last_time_us_;
  std::optional<Stamp> last_stamp_;
  std::optional<int> last_relative_;  ///< azimuth past the cut of the last sequence
};

}  // namespace kiln::velodyne
