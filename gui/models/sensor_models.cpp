#include "gui/models/sensor_models.h"

#include <algorithm>
#include <cmath>

#include "common/geom/frames.h"

namespace kiln::gui {

namespace {

bool holds(const std::vector<Topic>& topics, Topic topic) {
  return std::find(topics.begin(), topics.end(), topic) != topics.end();
}

}  // namespace

CloudModel::CloudModel(Link& link, QObject* parent) : Model(link, kVideoAge, parent) {
  connect(&link, &Link::absent, this, [this](const std::vector<Topic>& topics) {
    if (!holds(topics, Topic::Cloud)) return;
    cloud_.reset();
    forget();
  });
  connect(&link, &Link::cloud, this, [this](PointCloudPtr cloud) {
    cloud_ = std::move(cloud);
    arrived(cloud_->stamp);
  });
}

ThermalModel::ThermalModel(Link& link, QObject* parent) : Model(link, kVideoAge, parent) {
  connect(&link, &Link::restarted, this, [this] { advanced_ = stationNow(); });
  connect(&link, &Link::absent, this, [this](const std::vector<Topic>& topics) {
    if (!holds(topics, Topic::Thermal)) return touch();
    image_.reset();
    forget();
  });
  connect(&link, &Link::thermal, this, [this](ThermalImagePtr image) {
    if (!image_ || image->frame_counter != image_->frame_counter) advanced_ = stationNow();
    image_ = std::move(image);
    arrived(image_->stamp);
  });
}

double ThermalModel::frozenS() const { return image_ ? toSeconds(stationNow() - advanced_) : -1.0; }

CameraModel::CameraModel(Link& link, std::string frame, QObject* parent)
    : Model(link, kVideoAge, parent), frame_(std::move(frame)) {
  connect(&link, &Link::absent, this, [this](const std::vector<Topic>& topics) {
    if (!holds(topics, frame_ == frames::kRgb ? Topic::HeadCamera : Topic::OperatorCamera)) return;
    image_.reset();
    forget();
  });
  connect(&link, &Link::image, this, [this](RgbImagePtr image) {
    // A picture that could not be decoded comes without pixels: for the view to name, no fresh
    // view.
    if (image->frame != frame_ || image->data.empty()) return;
    image_ = std::move(image);
    arrived(image_->stamp);
  });
}

SceneModel::SceneModel(Link& link, QObject* parent) : Model(link, kSlowAge, parent) {
  connect(&link, &Link::restarted, this, [this] {
    driven_.clear();
    touch();
  });
  connect(&link, &Link::scene, this, [this](std::shared_ptr<const Scene> scene) {
    scene_ = std::move(scene);
    arrived(scene_->stamp);
  });
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    addPose(status->X_map_base);
  });
}

void SceneModel::addPose(const Pose2& pose) {
  if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m)) return;
  if (!driven_.empty() &&
      std::hypot(pose.x_m - driven_.back().x_m, pose.y_m - driven_.back().y_m) < kDrivenSpacing_m) {
    return;
  }
  // Thin the old half instead of forgetting where the mission began.
  if (driven_.size() >= kMaxDriven) {
    std::vector<Pose2> thinned;
    thinned.reserve(kMaxDriven);
    for (std::size_t i = 0; i < driven_.size(); i += 2) thinned.push_back(driven_[i]);
    driven_ = std::move(thinned);
  }
  driven_.push_back(pose);
  touch();
}

}  // namespace kiln::gui
