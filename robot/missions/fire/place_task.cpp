#include "robot/missions/fire/place_task.h"

#include <utility>

namespace kiln {
namespace {

BoxLocator::Config withSizes(BoxLocator::Config config, const FireSiteMap& site) {
  config.sizes.box = site.box_size_m;
  config.sizes.opening = site.opening_m;
  config.sizes.recess = site.recess_m;
  config.sizes.table = site.table_size_m;
  config.sizes.table_height = site.table_height_m;
  return config;
}

}  // namespace

void PlaceTask::Config::visit(ConfigArchive& a) {
  a.section("locator", locator, "fire box in the cloud");
  a.field("latency_s", latency_s, "s", 0, 2, "modelled latency in lockstep");
}

PlaceTask::PlaceTask(const Config& config, const FireSiteMap& site, Scans scans, Executor& executor)
    : latency_s_(config.latency_s),
      executor_(executor),
      scans_(std::move(scans)),
      locator_(withSizes(config.locator, site)) {}

void PlaceTask::begin(const std::string& place, const Eigen::Isometry3d& X_map_front) {
  question_ = {question_.number + 1, place, X_map_front};
  answer_.reset();
  post();
}

void PlaceTask::tick() {
  for (Answer& answer : answers_.drain())
    if (answer.number == question_.number) answer_ = std::move(answer.check);
  if (waiting_) post();
}

void PlaceTask::clear() {
  ++question_.number;
  waiting_ = false;
  answer_.reset();
}

void PlaceTask::post() {
  // The clouds are shared; what the pool reads never changes.
  waiting_ = !executor_.post(
      {"place", fromSeconds(latency_s_),
       [this, question = question_, scans = scans_()](std::stop_token) -> Delivery {
         Answer answer{question.number,
                       locator_.check(question.place, question.X_map_front, scans)};
         return [this, answer = std::move(answer)]() mutable { answers_.push(std::move(answer)); };
       }});
}

}  // namespace kiln
