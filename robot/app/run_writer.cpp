#include "robot/app/run_writer.h"

#include "common/record/run_topics.h"
#include "common/record/schema.h"
#include "common/wire/command.h"
#include "common/wire/recording.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"

namespace kiln {

Result<std::unique_ptr<RunWriter>> RunWriter::create(const std::string& path,
                                                     const std::string& library) {
  RecordWriter::Config config;
  config.library = library;
  auto file = RecordWriter::create(path, config);
  if (!file) return tl::make_unexpected(file.error());
  return std::unique_ptr<RunWriter>(new RunWriter(std::move(*file)));
}

Result<void> RunWriter::write(std::string_view topic, std::string_view schema, Stamp now,
                              Stamp published, std::string_view data) {
  auto channel = channels_.find(topic);
  if (channel == channels_.end()) {
    const auto description = protobufSchema(schema);
    if (!description) return tl::make_unexpected(description.error());
    const auto added = file_->addChannel(std::string(topic), *description);
    if (!added) return tl::make_unexpected(added.error());
    channel = channels_.emplace(topic, *added).first;
  }
  return file_->write(channel->second, now, published, data);
}

Result<void> RunWriter::published(Topic topic, const std::string& payload, Stamp now) {
  if (topic == Topic::HeadCamera || topic == Topic::OperatorCamera) {
    const auto picture = wire::decodeJpeg(payload);
    if (!picture) return {};  // encoded by this very process; nothing to be had from it
    return write(run::topicName(topic), run::schemaName(topic), now, picture->stamp,
                 foxglove::encode(*picture));
  }
  if (auto written = write(run::topicName(topic), run::schemaName(topic), now, now, payload);
      !written)
    return written;
  if (topic == Topic::Thermal) {
    if (const auto image = wire::decodeThermal(payload)) {
      return write(run::kThermalImage, "foxglove.RawImage", now, image->stamp,
                   foxglove::encode(*image));
    }
  }
  if (topic == Topic::Log) {
    const auto batch = wire::decodeLogBatch(payload);
    for (const LogLine& line : batch ? batch->lines : std::vector<LogLine>{}) {
      if (auto written = write(run::kLog, "foxglove.Log", now, line.stamp, foxglove::encode(line));
          !written)
        return written;
    }
  }
  return {};
}

Result<void> RunWriter::scan(const PointCloud& scan, Stamp now) {
  return write(run::kLidarScan, "foxglove.PointCloud", now, scan.stamp, foxglove::encode(scan));
}

Result<void> RunWriter::devices(const DeviceSample& sample) {
  return write(run::kDevices, "kiln.v1.DeviceSample", sample.stamp, sample.stamp,
               wire::encode(sample));
}

Result<void> RunWriter::transforms(std::span<const foxglove::FrameTransform> transforms,
                                   Stamp now) {
  return write(run::kTransforms, "foxglove.FrameTransforms", now, now,
               foxglove::encode(transforms));
}

Result<void> RunWriter::pose(Stamp stamp, const Eigen::Isometry3d& X_map_base) {
  return write(run::kPose, "foxglove.PoseInFrame", stamp, stamp,
               foxglove::encodePose(stamp, "map", X_map_base));
}

Result<void> RunWriter::command(const Command& command, Stamp received) {
  return write(run::kCommands, "kiln.v1.ToRobot", received, command.issued,
               wire::encode(ToRobot{command}));
}

Result<void> RunWriter::ack(const CommandAck& ack, Stamp now) {
  return write(run::kAcks, "kiln.v1.ToStation", now, now, wire::encode(ToStation{ack}));
}

}  // namespace kiln
