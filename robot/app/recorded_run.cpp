#include "robot/app/recorded_run.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/record/foxglove.h"
#include "common/record/run_topics.h"
#include "common/wire/recording.h"
#include "common/wire/sensor.h"

namespace kiln {
namespace {

struct RecordedArm final : Arm {
  [[nodiscard]] std::optional<ArmState> state() const override { return latest; }
  Result<void> servo(const ArmServo&) override { return {}; }
  Result<void> releaseProtectiveStop() override { return {}; }
  Result<void> setPayload(const ArmPayload&) override { return {}; }
  Result<void> zeroForceSensor() override { return {}; }
  std::optional<ArmState> latest;
};
struct RecordedBase final : DriveBase {
  [[nodiscard]] std::optional<BaseState> state() const override { return latest; }
  Result<void> write(const WheelCommands&) override { return {}; }
  std::optional<BaseState> latest;
};
struct RecordedPumps final : Pumps {
  [[nodiscard]] std::optional<PumpsState> state() const override { return latest; }
  Result<void> write(const std::array<double, 2>&) override { return {}; }
  std::optional<PumpsState> latest;
};

/// Lidar, ThermalCamera or RgbCamera.
template <class Interface, class Frame>
struct RecordedSensor final : Interface {
  Result<void> start(Sink<std::shared_ptr<const Frame>> to) override {
    sink = std::move(to);
    return {};
  }
  void stop() override { sink = nullptr; }
  void deliver(Frame frame) const {
    if (sink) sink(std::make_shared<const Frame>(std::move(frame)));
  }
  Sink<std::shared_ptr<const Frame>> sink;
};

std::optional<RgbImage> unpack(const JpegImage& jpeg) {
  const cv::Mat bgr = cv::imdecode(jpeg.jpeg, cv::IMREAD_COLOR);
  if (bgr.empty()) return std::nullopt;
  RgbImage image{jpeg.stamp, jpeg.seq, jpeg.frame, bgr.cols, bgr.rows, {}};
  image.data.resize(3u * static_cast<std::size_t>(bgr.cols) * static_cast<std::size_t>(bgr.rows));
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, image.data.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return image;
}

std::vector<std::string> topics() {
  return {std::string(run::kDevices), std::string(run::kLidarScan), run::topicName(Topic::Thermal),
          std::string(run::kOperatorCamera)};
}

}  // namespace

struct RecordedRun::Impl {
  Impl(RecordReader reader, const Clock& wall) : player(std::move(reader), topics(), wall) {}

  void take(const DeviceSample& sample) {
    if (sample.arm) arm.latest = sample.arm;
    if (sample.base) base.latest = sample.base;
    if (sample.pumps) pumps.latest = sample.pumps;
    resets = sample.resets;
  }
  Result<void> takePicture(const RecordedMessage& message) {
    if (!camera.sink) return {};
    auto jpeg = foxglove::decodeCompressedImage(message.data);
    if (!jpeg) return tl::make_unexpected(jpeg.error());
    jpeg->seq = message.sequence;
    if (auto image = unpack(*jpeg)) camera.deliver(std::move(*image));
    return {};
  }

  Player player;
  RecordedArm arm;
  RecordedBase base;
  RecordedPumps pumps;
  RecordedSensor<Lidar, PointCloud> lidar;
  RecordedSensor<ThermalCamera, ThermalImage> thermal;
  RecordedSensor<RgbCamera, RgbImage> camera;
  std::uint32_t resets = 0;
  std::optional<Pose2> start_pose;
};

Result<std::unique_ptr<RecordedRun>> RecordedRun::open(const std::string& path, const Clock& wall) {
  auto reader = RecordReader::open(path);
  if (!reader) return tl::make_unexpected(reader.error());
  const auto device = run::requireMessages(*reader, run::kDevices);
  if (!device) return tl::make_unexpected(device.error());
  const auto scan = run::requireMessages(*reader, run::kLidarScan);
  if (!scan) return tl::make_unexpected(scan.error());
  const auto sample = wire::decodeDeviceSample(device->data);
  if (!sample) return tl::make_unexpected(sample.error());
  auto impl = std::make_unique<Impl>(std::move(*reader), wall);
  impl->take(*sample);
  impl->start_pose = sample->X_map_odom * sample->X_odom_base;
  return std::unique_ptr<RecordedRun>(new RecordedRun(std::move(impl)));
}

RecordedRun::RecordedRun(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordedRun::~RecordedRun() = default;

Devices RecordedRun::devices() {
  Impl& m = *impl_;
  Devices all{m.arm, m.base, &m.pumps};
  all.lidar = &m.lidar;
  all.thermal = &m.thermal;
  all.operator_camera = &m.camera;
  all.connected = [&m] { return !m.player.ended(); };
  all.resets = [&m] { return m.resets; };
  return all;
}

std::optional<Pose2> RecordedRun::startPose() const { return impl_->start_pose; }
Player& RecordedRun::player() { return impl_->player; }

Result<void> RecordedRun::deliver(const RecordedMessage& message) {
  Impl& m = *impl_;
  if (message.topic == run::kDevices) {
    const auto sample = wire::decodeDeviceSample(message.data);
    if (!sample) return tl::make_unexpected(sample.error());
    m.take(*sample);
  } else if (message.topic == run::kLidarScan) {
    auto scan = foxglove::decodePointCloud(message.data);
    if (!scan) return tl::make_unexpected(scan.error());
    scan->seq = message.sequence;
    m.lidar.deliver(std::move(*scan));
  } else if (message.topic == run::topicName(Topic::Thermal)) {
    auto image = wire::decodeThermal(message.data);
    if (!image) return tl::make_unexpected(image.error());
    m.thermal.deliver(std::move(*image));
  } else if (message.topic == run::kOperatorCamera) {
    return m.takePicture(message);
  }
  return {};
}

}  // namespace kiln
