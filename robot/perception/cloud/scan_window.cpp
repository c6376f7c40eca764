#include "robot/perception/cloud/scan_window.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln {
void ScanWindow::Config::visit(ConfigArchive& a) {
  a.field("max_scans", max_scans, "", 1, 500, "kept");
  a.field("max_age_s", max_age_s, "s", 0.1, 600, "people walk, furniture is moved");
  a.field("step_m", step_m, "m", 0, 5, "LiDAR or base moved so far: a new view");
  a.field("step_deg", step_deg, "deg", 0, 90, "or turned so far");
  a.field("newest", newest, "", 1, 100, "of the newest are kept in any case");
}

bool ScanWindow::newView(const Entry& before, const Entry& after) const {
  const Eigen::Isometry3d moved =
      (before.X_map_base * before.X_base_lidar).inverse() * after.X_map_base * after.X_base_lidar;
  return moved.translation().norm() >= config_.step_m ||
         rotationAngle(moved) >= config_.step_deg * kDeg;
}

void ScanWindow::add(Entry entry) {
  if (!entry.scan_base || !isFinite(entry.X_map_base) || !isFinite(entry.X_base_lidar)) return;
  if (!entries_.empty() && entry.scan_base->stamp <= entries_.back().scan_base->stamp) return;
  entries_.push_back(std::move(entry));
  // What has just ceased to be one of the newest stays only as a view of its own.
  const auto newest = static_cast<std::size_t>(config_.newest);
  if (entries_.size() > newest + 1) {
    const std::size_t old = entries_.size() - newest - 1;
    if (!newView(entries_[old - 1], entries_[old]))
      entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(old));
  }
  const Stamp now = entries_.back().scan_base->stamp;
  while (entries_.size() > static_cast<std::size_t>(config_.max_scans) ||
         now - entries_.front().scan_base->stamp > fromSeconds(config_.max_age_s))
    entries_.pop_front();
}

}  // namespace kiln
