#include "robot/app/live_surroundings.h"

namespace kiln {

void LiveSurroundings::Config::visit(ConfigArchive& a) {
  a.section("obstacles", obstacles, "what stands around, remembered");
  a.section("window", window, "scans kept for slow questions");
}

LiveSurroundings::LiveSurroundings(const Config& config)
    : memory_(config.obstacles), window_(config.window) {}

void LiveSurroundings::add(const Scan& scan) {
  memory_.add(scan.obstacles, scan.X_odom_base);
  window_.add({scan.scan_base, scan.X_map_base, scan.obstacles.X_base_lidar, scan.lidar_track,
               scan.X_odom_base});
}

void LiveSurroundings::clear() {
  memory_.clear();
  window_.clear();
}

}  // namespace kiln
