#include "robot/missions/fire/heat_task.h"

#include <algorithm>
#include <utility>

namespace kiln {
namespace {

constexpr double kClockError_s = 0.02;  // console.md section 3, row 15

double ageOf(Stamp stamp, Stamp now) { return toSeconds(now - stamp); }

}  // namespace

namespace {

/// What helps when this image is refused.
std::string adviceFor(const ThermalImage& image) {
  if (image.agc) return "switch AGC off in the camera";
  if (!image.tlinear) return "switch telemetry and TLinear on in the camera";
  // Each closing of the shutter spoils some pictures in a row.
  return "wait for the shutter; else start the camera anew";
}

}  // namespace

void HeatTask::Config::visit(ConfigArchive& a) {
  a.section("detector", detector, "thermal picture");
  a.section("localizer", localizer, "heat source over a sweep");
  a.field("image_age_s", image_age_s, "s", 0.1, 10, "oldest allowed thermal image");
  a.field("detection_age_s", detection_age_s, "s", 0.2, 10,
          "how late a heat detection may be while images arrive");
}

HeatTask::HeatTask(const Config& config, Executor& executor)
    : config_(config), executor_(executor), detector_(config.detector), sweep_(config.localizer) {}

void HeatTask::onThermal(ThermalImagePtr image) { images_.push(std::move(image)); }

void HeatTask::dispatch() {
  const auto image = images_.pop();
  if (!image) return;
  last_image_ = (*image)->stamp;
  const bool posted = executor_.post(
      {"heat", fromSeconds(config_.detector.modelled_latency_s),
       [this, image = *image](std::stop_token) -> Delivery {
         auto result = std::make_shared<Result>(Result{image, detector_.detect(*image)});
         return [this, result] { results_.push(std::move(*result)); };
       }});
  if (!posted) ++refused_jobs_;
}

std::vector<HeatTask::Result> HeatTask::take() {
  auto results = results_.drain();
  for (const Result& result : results) {
    last_detection_ = result.image->stamp;
    refusal_ = result.detections.usable            ? ""
               : result.detections.refusal.empty() ? "its pictures are refused"
                                                   : result.detections.refusal;
    advice_ = adviceFor(*result.image);
    if (result.detections.usable) last_usable_ = result.detections.stamp;
  }
  return results;
}

std::string HeatTask::late(Stamp now) const {
  if (!last_image_ || ageOf(*last_image_, now) > config_.image_age_s) return {};
  if (!last_detection_) return "no heat detection yet although the thermal camera delivers";
  // A picture that the shutter spoils is a product too: it is delivered, and refused.
  const double age_s = ageOf(*last_detection_, now);
  if (age_s <= config_.image_age_s + config_.detection_age_s) return {};
  return fmt::format("no heat detection for {:.1f} s although the thermal camera delivers", age_s);
}

std::vector<Check> HeatTask::checks(Stamp now) const {
  Check camera{"Thermal camera", false, "no data yet", "check its USB cable"};
  if (last_image_) {
    const double age_s = ageOf(*last_image_, now);
    camera.detail = fmt::format("{:.2f} s old", std::max(0.0, age_s));
    if (age_s > config_.image_age_s) {
      camera.detail = fmt::format("no data for {:.1f} s", age_s);
    } else if (age_s < -kClockError_s) {
      camera.detail = fmt::format("its clock is {:.0f} ms ahead", -1e3 * age_s);
      camera.action = "restart it; if it stays, synchronise its clock with the robot's";
    } else if (!refusal_.empty() &&
               (!last_usable_ || ageOf(*last_usable_, now) > config_.image_age_s)) {
      camera.detail = refusal_;
      camera.action = advice_;
    } else {
      camera.ok = true;
      camera.action.clear();
    }
  }
  const std::string owed = late(now);
  Check heat{"Heat detection", owed.empty(), owed};
  if (owed.empty())
    heat.detail = last_detection_ ? fmt::format("{:.2f} s old", ageOf(*last_detection_, now))
                                  : std::string("none yet");
  else
    heat.action = "restart the daemon; if it stays, the machine is too slow";
  return {camera, heat};
}

std::uint64_t HeatTask::droppedFrames() const {
  return images_.dropped() + results_.dropped() + refused_jobs_;
}

}  // namespace kiln
