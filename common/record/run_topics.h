#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/record/record_reader.h"
#include "common/transport/topics.h"

/// Topic names inside a Kiln recording.
namespace kiln::run {

inline constexpr std::string_view kLidarScan = "/lidar/scan";  ///< foxglove.PointCloud, raw, lidar
inline constexpr std::string_view kThermalImage = "/thermal/image";  ///< foxglove.RawImage, mono16
inline constexpr std::string_view kHeadCamera = "/camera/head";  ///< foxglove.CompressedImage, jpeg
inline constexpr std::string_view kOperatorCamera = "/camera/operator";
inline constexpr std::string_view kTransforms = "/tf";  ///< foxglove.FrameTransforms
inline constexpr std::string_view kPose = "/pose";      ///< foxglove.PoseInFrame: base in map
inline constexpr std::string_view kLog = "/log";        ///< foxglove.Log
inline constexpr std::string_view kDevices = "/kiln/devices";    ///< kiln.v1.DeviceSample
inline constexpr std::string_view kCommands = "/kiln/commands";  ///< kiln.v1.ToRobot
inline constexpr std::string_view kAcks = "/kiln/acks";          ///< kiln.v1.ToStation

/// Only in recordings up to protocol 2: kiln.fire.v1.HeatDetections, kiln.v1 then.
inline constexpr std::string_view kProtocol2Detections = "/kiln/heat";

inline constexpr std::string_view kConfigAttachment = "robot.yaml";  ///< effective configuration
inline constexpr std::string_view kRunAttachment = "run.json";       ///< version, mission, times

/// "/kiln/robot_status": what the robot published on `topic`, byte for byte. The cameras' pictures
/// stand as foxglove.CompressedImage instead: "/camera/operator".
[[nodiscard]] std::string topicName(Topic topic);
[[nodiscard]] std::optional<Topic> publishedTopic(std::string_view name);
/// Full name of the message that a topic carries in a recording: "kiln.v1.RobotStatus".
[[nodiscard]] std::string_view schemaName(Topic topic);

/// The first message of `topic` that can be read. Error: InvalidInput, with what is missing from
/// the file: the topic, its messages, or that it is a recording of another robot.
[[nodiscard]] Result<RecordedMessage> requireMessages(const RecordReader& reader,
                                                      std::string_view topic);

/// Of a file without any topic of ours: whose it is, or that it is empty. InvalidInput.
[[nodiscard]] Error notOurs(const RecordReader& reader);

}  // namespace kiln::run
