#include "robot/app/telemetry_hub.h"

#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/geom/frames.h"

namespace kiln {
namespace {

constexpr double kLogRate_hz = 2.0;
constexpr std::uint32_t kWallColour = 0x9aa3ab, kFurnitureColour = 0x8a7f70, kSiteColour = 0xb5734a;

JpegImagePtr encode(const RgbImage& image, int quality) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<std::uint8_t*>(image.data.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  auto out = std::make_shared<JpegImage>();
  out->stamp = image.stamp;
  out->seq = image.seq;
  out->frame = image.frame;
  out->width = image.width;
  out->height = image.height;
  cv::imencode(".jpg", bgr, out->jpeg, {cv::IMWRITE_JPEG_QUALITY, quality});
  return out;
}

SceneBox sceneBox(const BoxConfig& box, std::uint32_t rgb) {
  return {box.name, box.center.pose(),
          0.5 * Eigen::Vector3d(box.size_m[0], box.size_m[1], box.size_m[2]), rgb};
}

}  // namespace

TelemetryHub::TelemetryHub(Config config, OperatorLink* link, Executor& executor)
    : config_(config), link_(link), executor_(executor) {}

bool TelemetryHub::due(std::optional<Stamp>& last, double rate_hz, Stamp now) {
  if (!link_) return false;
  // Half a mission tick of slack: a rate that divides the tick's must not lose every second turn to
  // rounding.
  if (last && toSeconds(now - *last) < 1.0 / rate_hz - 0.01) return false;
  last = now;
  return true;
}

bool TelemetryHub::fsmDue(Stamp now, std::uint64_t step) {
  if (step != last_step_) last_fsm_.reset();  // a transition is told at once
  last_step_ = step;
  return due(last_fsm_, config_.fsm_rate_hz, now);
}

void TelemetryHub::onPicture(RgbImagePtr image) {
  if (!link_ || !link_->wanted(image->frame)) return;
  LatestValue<Stamp>& newest =
      image->frame == frames::kOperatorCamera ? last_picture_ : last_head_picture_;
  const auto last = newest.peek();
  if (last && toSeconds(image->stamp - *last) < 0.9 / config_.picture_rate_hz) return;
  newest.put(image->stamp);
  executor_.post({"jpeg", Duration::zero(), [this, image](std::stop_token) -> Delivery {
                    return [this, jpeg = encode(*image, config_.jpeg_quality)] {
                      link_->publish(jpeg);
                    };
                  }});
}

void TelemetryHub::onLog(const LogRecord& record, Stamp now) {
  if (link_ && record.level >= 2) log_.push({now, record.level, record.logger, record.text});
}

void TelemetryHub::flushLog(Stamp now) {
  if (log_.size() == 0 || !due(last_log_, kLogRate_hz, now)) return;
  LogBatch batch;
  batch.lines = log_.drain();
  batch.dropped = log_.dropped();
  link_->publish(std::move(batch));
}

std::vector<SceneBox> sceneBoxes(const ArenaMap& arena) {
  std::vector<SceneBox> boxes;
  for (const BoxConfig& wall : arena.walls) boxes.push_back(sceneBox(wall, kWallColour));
  for (const BoxConfig& item : arena.furniture) boxes.push_back(sceneBox(item, kFurnitureColour));
  for (const auto& [mission, site] : arena.fixtures)
    for (const BoxConfig& item : site.boxes) boxes.push_back(sceneBox(item, kSiteColour));
  return boxes;
}

}  // namespace kiln
