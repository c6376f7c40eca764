#include "robot/missions/wall/marker_task.h"

#include <utility>

namespace kiln {
namespace {

constexpr double kStill_rad = 0.002, kStill_m = 0.002;  // in a tenth of a second

}  // namespace

struct MarkerTask::Eyes {
  explicit Eyes(const Config& config) : detector(config.detector), localizer(config.localizer) {}
  MarkerDetector detector;
  MarkerLocalizer localizer;
  std::uint64_t number = 0;  ///< whose pictures the localizer holds
};

void MarkerTask::Config::visit(ConfigArchive& a) {
  a.section("detector", detector, "marker in one picture");
  a.section("localizer", localizer, "marker on the ground");
  a.section("ground", ground, "ground before the robot, by the LiDAR");
  a.field("latency_s", latency_s, "s", 0, 5, "modelled latency of a picture in lockstep");
  a.field("search_latency_s", search_latency_s, "s", 0, 5, "modelled latency of the pose");
}

MarkerTask::MarkerTask(const Config& config, const MissionParts& parts)
    : config_(config), parts_(parts), eyes_(std::make_shared<Eyes>(config)) {}
MarkerTask::~MarkerTask() = default;

void MarkerTask::onPicture(RgbImagePtr image) { images_.push(std::move(image)); }

void MarkerTask::begin(Stamp now) {
  clear();
  since_ = now;
  listening_ = true;
}

void MarkerTask::ask() {
  listening_ = false;
  asked_ = true;
  dispatch();
}

void MarkerTask::clear() {
  ++number_;
  listening_ = asked_ = false;
  pictures_ = candidates_ = 0;
  answer_.reset();
}

void MarkerTask::tick() {
  for (Done& done : done_.drain()) {
    busy_ = false;
    if (done.number != number_) continue;
    if (done.search) {
      answer_ = std::move(done.search);
    } else {
      ++pictures_;
      candidates_ += done.candidate ? 1 : 0;
    }
  }
  dispatch();
}

void MarkerTask::dispatch() {
  if (busy_) return;
  if (listening_) {
    if (const auto image = images_.pop(); image && (*image)->stamp >= since_) look(*image);
    return;
  }
  if (!asked_) return;
  busy_ = parts_.executor.post(
      {"marker", fromSeconds(config_.search_latency_s),
       [this, eyes = eyes_, number = number_](std::stop_token) -> Delivery {
         Done done{number, false, MarkerSearch{}};
         if (eyes->number == number) done.search = eyes->localizer.search();
         return [this, done = std::move(done)]() mutable { done_.push(std::move(done)); };
       }});
  asked_ = !busy_;
}

/// Where the camera was is asked now: the history of the joints is short.
void MarkerTask::look(const RgbImagePtr& image) {
  const auto body = parts_.body_at(image->stamp);
  const auto scans = parts_.scans();
  // The head at rest: what is a hundredth of a second off in the stamps is centimetres on the ground.
  constexpr Duration kBefore = std::chrono::milliseconds(100);
  const auto before = parts_.body_at(image->stamp - kBefore);
  if (!body || !before || scans.empty()) return;
  const Eigen::Isometry3d moved = before->X_base_flange.inverse() * body->X_base_flange;
  if (rotationAngle(moved) > kStill_rad || moved.translation().norm() > kStill_m) return;
  MarkerViewpoint from;
  from.X_base_rgb = body->X_base_flange * parts_.robot.X_flange_rgb.pose();
  from.X_odom_base = body->X_odom_base;
  busy_ = parts_.executor.post(
      {"marker", fromSeconds(config_.latency_s),
       [this, eyes = eyes_, number = number_, image, from,
        scan = scans.back().scan_base](std::stop_token) mutable -> Delivery {
         if (eyes->number != number) eyes->localizer.reset();
         eyes->number = number;
         const MarkerView view = eyes->detector.detect(*image);
         const auto ray = winnerRay(view, eyes->localizer.camera());
         Done done{number, false, std::nullopt};
         if (ray) {
           const auto ground =
               groundAlongRay(*scan, from.X_base_rgb.translation(), from.X_base_rgb.linear() * *ray,
                              config_.localizer.max_range_m, config_.ground);
           done.candidate = ground.has_value();
           if (ground) from.ground = *ground;
           if (ground) eyes->localizer.add(view, from);
         }
         return [this, done = std::move(done)]() mutable { done_.push(std::move(done)); };
       }});
}

}  // namespace kiln
