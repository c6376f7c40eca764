#include "robot/app/live_surroundings.h"

namespace kiln {
namespace {

BoxLocator::Config withSizes(BoxLocator::Config config, const FireBoxSizes& sizes) {
  config.sizes = sizes;
  return config;
}

}  // namespace

FireBoxSizes fireBoxSizes(const ArenaMap& arena) {
  FireBoxSizes sizes;
  sizes.box = arena.box_size_m;
  sizes.opening = arena.opening_m;
  sizes.recess = arena.recess_m;
  sizes.table = arena.table_size_m;
  sizes.table_height = arena.table_height_m;
  return sizes;
}

void LiveSurroundings::Config::visit(ConfigArchive& a) {
  a.section("obstacles", obstacles, "what stands around, remembered");
  a.section("window", window, "scans kept for slow questions");
  a.section("locator", locator, "fire box in the cloud");
  a.field("locate_latency_s", locate_latency_s, "s", 0, 2, "modelled latency in lockstep");
}

LiveSurroundings::LiveSurroundings(const Config& config, const FireBoxSizes& sizes,
                                   Executor& executor)
    : config_(config),
      executor_(executor),
      locator_(withSizes(config.locator, sizes)),
      memory_(config.obstacles),
      window_(config.window) {}

void LiveSurroundings::add(const Scan& scan) {
  memory_.add(scan.obstacles, scan.X_odom_base);
  window_.add({scan.scan_base, scan.X_map_base, scan.obstacles.X_base_lidar});
}

void LiveSurroundings::clear() {
  memory_.clear();
  window_.clear();
  answer_.reset();
}

void LiveSurroundings::tick(const Pose2& X_odom_base_now) {
  X_odom_base_ = X_odom_base_now;
  for (Answer& answer : answers_.drain())
    if (answer.number == question_.number) answer_ = std::move(answer.check);
  if (waiting_) post();
}

void LiveSurroundings::beginPlaceCheck(const std::string& place,
                                       const Eigen::Isometry3d& X_map_front) {
  question_ = {question_.number + 1, place, X_map_front};
  answer_.reset();
  post();
}

void LiveSurroundings::post() {
  // The clouds are shared; what the pool reads never changes.
  waiting_ = !executor_.post(
      {"place", fromSeconds(config_.locate_latency_s),
       [this, question = question_, scans = window_.entries()](std::stop_token) -> Delivery {
         Answer answer{question.number,
                       locator_.check(question.place, question.X_map_front, scans)};
         return [this, answer = std::move(answer)]() mutable { answers_.push(std::move(answer)); };
       }});
}

}  // namespace kiln
