#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "common/model/device_sample.h"
#include "common/model/link.h"
#include "common/record/foxglove.h"
#include "common/record/record_writer.h"
#include "common/transport/topics.h"

namespace kiln {

/// One file of a recorded run: which value stands on which topic in which layout
/// (record/run_topics.h). Thread-compatible.
class RunWriter {
 public:
  [[nodiscard]] static Result<std::unique_ptr<RunWriter>> create(const std::string& path,
                                                                 const std::string& library);

  /// @param payload  the published bytes. Thermal frames and log lines are written once more in the
  /// foxglove layouts, pictures in theirs alone.
  [[nodiscard]] Result<void> published(Topic topic, const std::string& payload, Stamp now);
  [[nodiscard]] Result<void> scan(const PointCloud& scan, Stamp now);
  [[nodiscard]] Result<void> devices(const DeviceSample& sample);
  [[nodiscard]] Result<void> transforms(std::span<const foxglove::FrameTransform> transforms,
                                        Stamp now);
  [[nodiscard]] Result<void> pose(Stamp stamp, const Eigen::Isometry3d& X_map_base);
  [[nodiscard]] Result<void> command(const Command& command, Stamp received);
  [[nodiscard]] Result<void> ack(const CommandAck& ack, Stamp now);
  [[nodiscard]] RecordWriter& file() { return *file_; }

 private:
  explicit RunWriter(std::unique_ptr<RecordWriter> file) : file_(std::move(file)) {}
  Result<void> write(std::string_view topic, std::string_view schema, Stamp now, Stamp published,
                     std::string_view data);
  std::unique_ptr<RecordWriter> file_;
  std::map<std::string, ChannelId, std::less<>> channels_;
};

}  // namespace kiln
